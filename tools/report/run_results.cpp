// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/run_results.hpp"

#include <algorithm>
#include <cmath>
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

/// A whole number that an int holds; else 0.
int whole(const Json& json, const std::string& key) {
  const double value = number(json, key);
  return std::abs(value) < 2e9 ? static_cast<int>(value) : 0;
}

NamedNumbers numbers(const Json& json) {
  NamedNumbers list;
  if (!json.is_object()) return list;
  for (const auto& [name, value] : json.items())
    if (value.is_number()) list.emplace_back(name, value.get<double>());
  return list;
}

std::vector<double> pose(const Json& json) {
  std::vector<double> matrix;
  for (const Json& value : json)
    if (value.is_number() && std::isfinite(value.get<double>()))
      matrix.push_back(value.get<double>());
  return matrix.size() == 16 && json.size() == 16 ? matrix : std::vector<double>();
}

ReportedObject to_object(const Json& json) {
  ReportedObject found{text(json, "model"),
                       whole(json, "obj_id"),
                       number(json, "confidence"),
                       number(json, "score"),
                       number(json, "density"),
                       number(json, "runner_up_density"),
                       number(json, "inlier_fraction"),
                       number(json, "rmse_m"),
                       pose(member(json, "T_scene_model")),
                       numbers(member(json, "clues")),
                       numbers(member(json, "against")),
                       text(json, "why"),
                       number(json, "pose_confidence")};
  for (const Json& other : member(json, "look_alikes"))
    if (const std::vector<double> motion = pose(member(other, "motion")); !motion.empty())
      found.look_alikes.emplace_back(
          Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(motion.data()),
          number(other, "probability"));
  if (found.model.empty()) found.model = "object " + member(json, "obj_id").dump();
  return found;
}

AnsweredFrame to_frame(const Json& json) {
  AnsweredFrame frame;
  frame.number = number(json, "frame");
  frame.file = text(json, "file");
  frame.name = text(json, "name");
  // Before names were written, they were the scans'.
  if (frame.name.empty()) frame.name = fs::path(frame.file).stem().string();
  frame.scene_id = whole(json, "scene_id");
  frame.im_id = whole(json, "im_id");
  frame.seconds = number(json, "seconds");
  frame.latency = number(json, "latency_s");
  for (const Json& found : member(json, "detections")) frame.found.push_back(to_object(found));
  for (const Json& best : member(json, "rejected")) frame.rejected.push_back(to_object(best));
  for (const Json& warning : member(json, "warnings"))
    frame.warnings.push_back(text(warning, "node") + ": " + text(warning, "what"));
  frame.stages = numbers(member(json, "stages"));
  return frame;
}

/// Summed up anew: the run's own totals are of its last start only.
class StageSums {
 public:
  void add(const NamedNumbers& stages) {
    for (const auto& [name, seconds] : stages) {
      graph::NodeTimes& stage = sums_[name];
      stage.node = name;
      ++stage.calls;
      stage.total += seconds;
      stage.max = std::max(stage.max, seconds);
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
    stages.add(run.frames.back().stages);
  }
  for (const Json& json : failed.items)
    run.failures.push_back(
        {number(json, "frame"), text(json, "file"), text(json, "node"), text(json, "what")});
  run.stages = stages.slowest_first();
  run.torn = answered.torn + failed.torn;
  return run;
}

}  // namespace posevote
