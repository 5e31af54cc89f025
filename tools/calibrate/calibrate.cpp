// SPDX-License-Identifier: BSD-3-Clause
#include "tools/calibrate/calibrate.hpp"

#include <cstdio>
#include <functional>
#include <map>
#include <stdexcept>

#include "nodes/poses/confidence.hpp"
#include "tools/calibrate/judged_poses.hpp"
#include "tools/calibrate/logistic.hpp"
#include "tools/commands.hpp"
#include "tools/evaluate/calibration.hpp"
#include "tools/experiment/test_set.hpp"
#include "tools/json_answer.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Poses = std::vector<JudgedPose>;

constexpr std::size_t kFolds = 5;

/// A run that keeps whatever the search looked at.
int run_on(const TestSet& set, const CalibrateCommand& command,
           const std::atomic<bool>& interrupted) {
  RunCommand run;
  run.config = set.config;
  run.dataset = set.dataset.string();
  run.out = (fs::path(command.out) / set.name).string();
  run.cache = (fs::path(command.out) / "cache").string();
  run.set = command.set;
  run.set.emplace_back("segment_objects.min_confidence=0");
  if (set.every > 1) run.shard = "1/" + std::to_string(set.every);
  run.resume = fs::exists(fs::path(run.out) / "effective.yaml");
  run.lines = false;
  return run_command(run, interrupted);
}

/// What is fitted of a pose, and what is known before.
struct Terms {
  std::vector<std::string> names;  ///< of the weights, as parameters
  std::string offset;
  std::function<Eigen::VectorXd(const JudgedPose&)> clues;
  std::function<double(const JudgedPose&)> known;  ///< log odds
};

Terms terms_of_shape() {
  Terms terms{{}, "confidence_offset", {}, {}};
  std::vector<std::size_t> fitted;
  for (std::size_t i = 0; i < kClueCount; ++i)
    if (!is_by_bayes(i)) {
      fitted.push_back(i);
      terms.names.push_back(std::string("confidence_") + kClueNames[i]);
    }
  terms.clues = [fitted](const JudgedPose& pose) {
    Eigen::VectorXd clues(std::ssize(fitted));
    for (std::size_t i = 0; i < fitted.size(); ++i)
      clues[static_cast<Eigen::Index>(i)] = pose.clues[fitted[i]];
    return clues;
  };
  terms.known = [](const JudgedPose& pose) {
    double log_odds = 0;
    for (std::size_t i = 0; i < kClueCount; ++i)
      if (is_by_bayes(i)) log_odds += pose.clues[i];
    return log_odds;
  };
  return terms;
}

/// Of poses that have them.
Terms terms_of_colors() {
  return {{"confidence_color_likeness", "confidence_color_tint"},
          "confidence_color_offset",
          [](const JudgedPose& pose) {
            return Eigen::VectorXd(Eigen::Vector2d(pose.colors->likeness, pose.colors->tint));
          },
          [](const JudgedPose& pose) {
            return poses::log_odds_of(pose.clues, poses::ConfidenceTerms());
          }};
}

Logistic fit(const Poses& poses, const Terms& terms) {
  const auto rows = static_cast<Eigen::Index>(poses.size());
  Eigen::MatrixXd clues(rows, std::ssize(terms.names));
  Eigen::VectorXd right(rows), known(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const JudgedPose& pose = poses[static_cast<std::size_t>(i)];
    clues.row(i) = terms.clues(pose).transpose();
    known[i] = terms.known(pose);
    right[i] = pose.right;
  }
  return fit_logistic(clues, right, Eigen::VectorXd::Ones(rows), known);
}

/// What the poses of every fifth image are given by weights from the others.
std::vector<Verdict> cross_validated(const Poses& poses, const Terms& terms) {
  std::map<std::pair<int, int>, std::size_t> images;
  for (const JudgedPose& pose : poses) images.try_emplace(pose.image, images.size());
  std::vector<Verdict> verdicts;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    Poses others, these;
    for (const JudgedPose& pose : poses)
      (images[pose.image] % kFolds == fold ? these : others).push_back(pose);
    if (these.empty() || others.empty()) continue;
    const Logistic fitted = fit(others, terms);
    for (const JudgedPose& pose : these)
      verdicts.push_back({poses::probability_of(terms.known(pose) + fitted.offset +
                                                fitted.weights.dot(terms.clues(pose))),
                          pose.right});
  }
  return verdicts;
}

nlohmann::ordered_json print(const std::vector<Verdict>& verdicts) {
  int right = 0, believed = 0, both = 0;
  for (const Verdict& verdict : verdicts) {
    right += verdict.correct;
    believed += verdict.score >= 0.5;
    both += verdict.correct && verdict.score >= 0.5;
  }
  const auto calibration = calibrate(verdicts);
  std::printf(
      "%zu poses, %d right; of images that the weights have not seen, at 0.5: %d believed, "
      "%d of them right; expected calibration error %.3f\n",
      verdicts.size(), right, believed, both, calibration ? calibration->error : 0);
  return {{"poses", verdicts.size()},
          {"right", right},
          {"believed", believed},
          {"believed_and_right", both},
          {"ece", calibration ? calibration->error : 0}};
}

std::string to_yaml(const Logistic& fitted, const Terms& terms) {
  std::string text = "segment_objects:\n";
  const auto add = [&text](const std::string& name, double value) {
    char line[64];
    std::snprintf(line, sizeof line, "  %s: %.4g\n", name.c_str(), value);
    text += line;
  };
  add(terms.offset, fitted.offset);
  for (std::size_t i = 0; i < terms.names.size(); ++i)
    add(terms.names[i], fitted.weights[Eigen::Index(i)]);
  return text;
}

}  // namespace

int calibrate_command(const CalibrateCommand& command, const std::atomic<bool>& interrupted) {
  const JsonAnswer answer(command.json);
  Poses all;
  int scene_offset = 0;  // images of different sets are different ones
  for (const std::string& text : command.sets) {
    const TestSet set = find_set(text, command.every, false, command.out, command.colors);
    if (const int status = run_on(set, command, interrupted); status != 0) return status;
    for (JudgedPose pose :
         judge_poses(fs::path(command.out) / set.name, set.dataset, command.rule)) {
      pose.image.first += scene_offset;
      all.push_back(pose);
    }
    scene_offset += 1 << 20;
  }
  if (command.colors) std::erase_if(all, [](const JudgedPose& pose) { return !pose.colors; });
  if (all.empty()) throw std::invalid_argument("nothing was found; expected poses to judge");
  const Terms terms = command.colors ? terms_of_colors() : terms_of_shape();
  nlohmann::ordered_json json = print(cross_validated(all, terms));
  const Logistic fitted = fit(all, terms);
  json[terms.offset] = fitted.offset;
  for (std::size_t i = 0; i < terms.names.size(); ++i)
    json[terms.names[i]] = fitted.weights[Eigen::Index(i)];
  answer.give(json);
  const std::string yaml = to_yaml(fitted, terms);
  const fs::path file = fs::path(command.out) / "confidence.yaml";
  write_text(file, yaml);
  std::printf("%swrote %s\n", yaml.c_str(), file.string().c_str());
  return 0;
}

}  // namespace posevote
