// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nodes/formats/json_text.hpp"
#include "tools/bench/bench.hpp"

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

std::string line(const std::string& what, double before, double after) {
  char text[128];
  std::snprintf(text, sizeof text, "%-32s %10.1f %10.1f %8.2f\n", what.c_str(), 1e3 * before,
                1e3 * after, before > 0 ? after / before : 0);
  return text;
}

}  // namespace

std::string compare_benches(const std::string& before, const std::string& after) {
  const Json a = read_bench(before), b = read_bench(after);
  char head[128];
  std::snprintf(head, sizeof head, "%-32s %10s %10s %8s\n", "", "before ms", "after ms", "ratio");
  std::string text = head;
  for (const auto& [name, old] : a.items()) {
    if (!b.contains(name)) continue;
    const Json& now = b[name];
    text += line(name, old["online_s"], now["online_s"]);
    text += line(name + " training", old.value("train_s", 0.0), now.value("train_s", 0.0));
    for (const auto& [stage, seconds] : old["stages_s"].items())
      if (now["stages_s"].contains(stage))
        text += line("  " + stage, seconds, now["stages_s"][stage]);
  }
  return text;
}

}  // namespace posevote
