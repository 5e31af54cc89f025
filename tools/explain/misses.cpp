// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/misses.hpp"

#include <algorithm>

#include "tools/evaluate/evaluate.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/explain/to_json.hpp"
#include "tools/progress/progress.hpp"
#include "tools/text.hpp"

namespace posevote::explain {
namespace {

/// What counts as missed: what `evaluate` counts, and in whose place none of its kind was found. One
/// that was found there, but turned otherwise, is a wrong detection, of which explain tells nothing.
class Counted {
 public:
  explicit Counted(const layouts::GroundTruth& truth)
      : truth_(truth), counts_(which_count(truth, EvaluateOptions().least_visible)) {}

  bool is_missed(const layouts::ImageKey& image, const Explained& one) {
    return is_asked_for(image, one) && !is_found(one);
  }

 private:
  bool is_asked_for(const layouts::ImageKey& image, const Explained& one) const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const layouts::TrueInstance& truth = truth_.instances[i];
      if (layouts::ImageKey(truth.scene_id, truth.im_id) == image && truth.obj_id == one.obj_id &&
          truth.T_scene_model.isApprox(one.truth->T_scene_model))
        return counts_[i];
    }
    return false;
  }

  bool is_found(const Explained& one) {
    constexpr double kNear = 0.1;  // x diameter: ADD-S
    if (!one.truth->near_same) return false;
    const layouts::TrueObject& object = truth_.objects.at(one.obj_id);
    const PoseMeter& meter = meters_.try_emplace(one.obj_id, object).first->second;
    return meter.adds(one.truth->T_scene_model, one.truth->T_near_same) <= kNear * object.diameter;
  }

  const layouts::GroundTruth& truth_;
  const std::vector<bool> counts_;
  std::map<int, PoseMeter> meters_;
};

std::string words(const Verdict& verdict) {
  std::string text = name_of(verdict.cause);
  if (!verdict.stage.empty()) text += ": " + verdict.stage;
  if (!verdict.detail.empty()) text += " (" + verdict.detail + ")";
  return text;
}

/// Cause and how often, the most frequent first.
std::vector<std::pair<std::string, std::size_t>> causes(const std::vector<Miss>& misses) {
  std::map<std::string, std::size_t> counts;
  for (const Miss& miss : misses) ++counts[name_of(miss.truth.cause)];
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

std::size_t confirmed(const std::vector<Miss>& misses) {
  return static_cast<std::size_t>(std::count_if(
      misses.begin(), misses.end(), [](const Miss& miss) { return miss.is_confirmed; }));
}

}  // namespace

bool is_confirmed(const Explained& one) {
  if (one.guess.cause == one.verdict.cause)
    return one.best_is_true || one.guess.stage == one.verdict.stage;
  // The candidate is the object, and what is most against it is said of both.
  if (one.guess.cause == Cause::kNoTrace && one.best_is_true &&
      one.verdict.cause == Cause::kRefused && one.guess.stage == one.verdict.stage)
    return true;
  constexpr std::array kWithoutTrace{Cause::kNotSeen, Cause::kFewFeatures, Cause::kNotMatched,
                                     Cause::kDisagree};
  return one.guess.cause == Cause::kNoTrace && std::find(kWithoutTrace.begin(), kWithoutTrace.end(),
                                                         one.verdict.cause) != kWithoutTrace.end();
}

std::map<int, std::vector<Eigen::Isometry3d>> poses_of(const layouts::GroundTruth& truth,
                                                       const layouts::ImageKey& image) {
  std::map<int, std::vector<Eigen::Isometry3d>> poses;
  for (const layouts::TrueInstance& one : truth.instances)
    if (layouts::ImageKey(one.scene_id, one.im_id) == image)
      poses[one.obj_id].push_back(one.T_scene_model);
  return poses;
}

std::vector<Miss> misses_of(const Run& run, const layouts::GroundTruth& truth,
                            const Request& request, std::size_t most) {
  std::vector<Miss> misses;
  Counted counted(truth);
  Progress progress({"scans", run.frames.size()});
  for (const FrameOfRun& frame : run.frames) {
    if (misses.size() >= most) break;
    if (!frame.failure.empty()) continue;
    const layouts::ImageKey image(frame.scene_id, frame.im_id);
    Request of = request;
    of.is_of_misses = true;
    of.truth = poses_of(truth, image);
    for (const Explained& one : explain(run, frame.name, of).objects)
      if (one.truth && counted.is_missed(image, one))
        misses.push_back(
            {frame.name, one.model, one.obj_id, one.guess, one.verdict, is_confirmed(one)});
    progress.advance();
  }
  return misses;
}

std::string to_text(const std::vector<Miss>& misses) {
  std::string text;
  for (const Miss& miss : misses)
    text += miss.scene + "  " + miss.model + "  " + words(miss.truth) +
            (miss.is_confirmed ? "" : "  (without its true pose: " + words(miss.named) + ")") +
            "\n";
  text += format("\n%zu missed", misses.size());
  for (const auto& [cause, count] : causes(misses)) text += format("; %zu ", count) + cause;
  return text +
         format(".\nWithout the true pose %zu of these causes are named.\n", confirmed(misses));
}

nlohmann::ordered_json to_json(const std::vector<Miss>& misses) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Miss& miss : misses)
    list.push_back({{"scene", miss.scene},
                    {"model", miss.model},
                    {"obj_id", miss.obj_id},
                    {"verdict", to_json(miss.truth)},
                    {"without_truth", to_json(miss.named)},
                    {"confirmed", miss.is_confirmed}});
  nlohmann::ordered_json counts = nlohmann::ordered_json::object();
  for (const auto& [cause, count] : causes(misses)) counts[cause] = count;
  return {{"missed", misses.size()},
          {"confirmed", confirmed(misses)},
          {"causes", counts},
          {"misses", list}};
}

}  // namespace posevote::explain
