// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nodes/formats/json_text.hpp"
#include "tools/bench/bench.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

using Json = nlohmann::ordered_json;

Json read_bench(const std::string& file) {
  try {
    auto methods = formats::read_json<Json>(file);
    for (const Json& method : methods) method.at("online_s").get<double>();
    return methods;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(
        file + ": not written by `posevote bench --out`: " + formats::reason_of(error));
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

Json row(const std::string& method, const std::string& what, double before, double after) {
  return {{"method", method},
          {"what", what},
          {"before_s", before},
          {"after_s", after},
          {"ratio", before > 0 ? after / before : 0}};
}

}  // namespace

Json compare_benches(const std::string& before, const std::string& after) {
  const Json a = read_bench(before), b = read_bench(after);
  Json rows = Json::array();
  for (const auto& [name, old] : a.items()) {
    if (!b.contains(name)) continue;
    const Json& now = b[name];
    rows.push_back(row(name, "scan", old["online_s"], now["online_s"]));
    rows.push_back(row(name, "training", old.value("train_s", 0.0), now.value("train_s", 0.0)));
    for (const auto& [stage, seconds] : old["stages_s"].items())
      if (now["stages_s"].contains(stage))
        rows.push_back(row(name, stage, seconds, now["stages_s"][stage]));
  }
  return rows;
}

std::string to_table(const Json& comparison) {
  std::string text = format("%-32s %10s %10s %8s\n", "", "before ms", "after ms", "ratio");
  for (const Json& row : comparison) {
    const std::string method = row["method"], what = row["what"];
    const std::string name = what == "scan"       ? method
                             : what == "training" ? method + " training"
                                                  : "  " + what;
    text += format("%-32s %10.1f %10.1f %8.2f\n", name.c_str(), 1e3 * row["before_s"].get<double>(),
                   1e3 * row["after_s"].get<double>(), row["ratio"].get<double>());
  }
  return text;
}

}  // namespace posevote
