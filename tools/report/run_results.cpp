// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/run_results.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "nodes/formats/results_writer.hpp"
#include "tools/report/folder.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const Json& member(const Json& json, const std::string& key) {
  static const Json kNothing;
  return json.is_object() && json.contains(key) ? json.at(key) : kNothing;
}

double number(const Json& json, const std::string& key) {
  const Json& value = member(json, key);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string text(const Json& json, const std::string& key) {
  const Json& value = member(json, key);
  return value.is_string() ? value.get<std::string>() : "";
}

FoundObject to_object(const Json& json) {
  FoundObject found{text(json, "model"),
                    number(json, "confidence"),
                    number(json, "density"),
                    number(json, "runner_up_density"),
                    number(json, "inlier_fraction"),
                    number(json, "rmse_m")};
  if (found.model.empty()) found.model = "object " + member(json, "obj_id").dump();
  return found;
}

AnsweredFrame to_frame(const Json& json) {
  AnsweredFrame frame{
      number(json, "frame"), text(json, "file"), text(json, "name"), number(json, "seconds"), {}};
  // Before pictures' names were written, they were the scans'.
  if (frame.name.empty()) frame.name = fs::path(frame.file).stem().string();
  for (const Json& found : member(json, "detections")) frame.found.push_back(to_object(found));
  return frame;
}

/// Summed up anew: the run's own totals are of its last start only.
class StageSums {
 public:
  void add(const Json& stages) {
    if (!stages.is_object()) return;
    for (const auto& [name, value] : stages.items()) {
      if (!value.is_number()) continue;
      graph::NodeTimes& stage = sums_[name];
      stage.node = name;
      ++stage.calls;
      stage.total += value.get<double>();
      stage.max = std::max(stage.max, value.get<double>());
    }
  }

  std::vector<graph::NodeTimes> slowest_first() const {
    std::vector<graph::NodeTimes> list;
    for (const auto& [name, stage] : sums_) list.push_back(stage);
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.total > b.total; });
    return list;
  }

 private:
  std::map<std::string, graph::NodeTimes> sums_;
};

}  // namespace

bool holds_run(const fs::path& folder) { return is_file(folder / "results.json"); }

RunResults read_run(const fs::path& folder) {
  RunResults run;
  const formats::WrittenFrames answered =
      formats::read_frames(folder / "results.json", "detections");
  const formats::WrittenFrames failed = formats::read_frames(folder / "failures.json", "what");
  run.left_out = formats::read_left_out(folder / "results.json");
  StageSums stages;
  for (const Json& json : answered.items) {
    run.frames.push_back(to_frame(json));
    stages.add(member(json, "stages"));
  }
  for (const Json& json : failed.items)
    run.failures.push_back(
        {number(json, "frame"), text(json, "file"), text(json, "node"), text(json, "what")});
  run.stages = stages.slowest_first();
  run.torn = answered.torn + failed.torn;
  return run;
}

}  // namespace posevote
