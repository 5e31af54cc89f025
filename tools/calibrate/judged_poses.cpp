// SPDX-License-Identifier: BSD-3-Clause
#include "tools/calibrate/judged_poses.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nodes/formats/results_writer.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/evaluate/results_json.hpp"

namespace posevote {
namespace {

using Json = nlohmann::ordered_json;

struct Found {
  std::vector<FoundInstance> poses;
  std::vector<Clues> clues;  ///< of each
  std::vector<std::optional<ColorClues>> colors;
};

void add(const Json& frame, const Json& detection, Found& found) {
  found.poses.push_back(found_instance(frame, detection));
  found.poses.back().line = static_cast<int>(found.poses.size());
  Clues& clues = found.clues.emplace_back();
  for (std::size_t i = 0; i < kClueCount; ++i)
    clues[i] = detection.at("clues").at(kClueNames[i]).get<double>();
  std::optional<ColorClues>& colors = found.colors.emplace_back();
  if (const auto said = detection.find("colors"); said != detection.end())
    colors = ColorClues{said->at("likeness").get<double>(), said->at("tint").get<double>()};
}

Found read_found(const std::filesystem::path& results) {
  Found found;
  try {
    for (const Json& frame : formats::read_frames(results, "detections").items)
      for (const Json& detection : frame.at("detections")) add(frame, detection, found);
  } catch (const Json::exception& error) {
    throw std::invalid_argument(results.string() + ": " + error.what() +
                                ": not of this build; choose another --out");
  }
  return found;
}

}  // namespace

std::vector<JudgedPose> judge_poses(const std::filesystem::path& run,
                                    const std::filesystem::path& dataset, const std::string& rule) {
  const Found found = read_found(run / "results.json");
  EvaluateOptions options;
  options.rules = rule;
  options.results = (run / "results.json").string();
  const Evaluation evaluation =
      evaluate(layouts::read_ground_truth(dataset.string(), "test"), found.poses, options);
  if (evaluation.rules.size() != 1 || evaluation.rules[0].average())
    throw std::invalid_argument("--rule " + rule + ": expected one that is met or not");
  std::vector<JudgedPose> judged;
  for (const Verdict& verdict : evaluation.all[0].verdicts) {
    const auto i = static_cast<std::size_t>(verdict.line - 1);
    judged.push_back({{found.poses[i].scene_id, found.poses[i].im_id},
                      found.clues[i],
                      found.colors[i],
                      verdict.correct});
  }
  return judged;
}

}  // namespace posevote
