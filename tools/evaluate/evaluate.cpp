// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluate.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "tools/evaluate/ground_truth.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/results_csv.hpp"

namespace posevote {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Scene, image, object.
using Key = std::tuple<int, int, int>;

/// One object in one image: what is there, what was found (best score first), how they differ.
struct Case {
  std::vector<std::size_t> instances;  ///< indices into the evaluation's instances
  std::vector<FoundInstance> found;
  std::vector<std::vector<PoseError>> errors;  ///< [found][instance]
};

/// For each found pose, the place of its instance, or kNone. `accept` says whether an error is
/// small enough, `order` which of two is smaller.
template <class Accept, class Order>
std::vector<std::size_t> match(const Case& group, const Accept& accept, const Order& order) {
  std::vector<bool> taken(group.instances.size());
  std::vector<std::size_t> matched;
  for (const std::vector<PoseError>& errors : group.errors) {
    std::size_t best = kNone;
    for (std::size_t i = 0; i < errors.size(); ++i)
      if (!taken[i] && accept(errors[i]) &&
          (best == kNone || order(errors[i]) < order(errors[best])))
        best = i;
    if (best != kNone) taken[best] = true;
    matched.push_back(best);
  }
  return matched;
}

/// Shows the pairs of `matched` in the table, where neither side is shown already.
void show(Evaluation& evaluation, const Case& group, const std::vector<std::size_t>& matched,
          std::vector<bool>& shown) {
  for (std::size_t k = 0; k < matched.size(); ++k) {
    if (matched[k] == kNone || shown[k]) continue;
    InstanceResult& result = evaluation.instances[group.instances[matched[k]]];
    if (result.found) continue;
    const PoseError& error = group.errors[k][matched[k]];
    shown[k] = result.found = true;
    result.score = group.found[k].score;
    result.mm = error.center * 1000;
    result.deg = error.rotation * 180 / std::numbers::pi;
    result.add_mm = error.add * 1000;
  }
}

/// Counts one rule. A detection of an instance that is not counted is neither right nor wrong.
void count(Evaluation& evaluation, const Case& group, const std::vector<std::size_t>& matched,
           bool InstanceResult::*ok, Counts& counts) {
  for (const std::size_t place : matched) {
    InstanceResult* result =
        place == kNone ? nullptr : &evaluation.instances[group.instances[place]];
    if (result) result->*ok = true;
    if (result && !result->counted) continue;
    ++counts.detections;
    if (result) ++counts.correct;
  }
  for (const std::size_t i : group.instances)
    if (evaluation.instances[i].counted) ++counts.instances;
}

void judge(Evaluation& evaluation, const Case& group, const TrueObject& object,
           RuleCounts& counts) {
  const EvaluateOptions& options = evaluation.options;
  const auto by_center = [](const PoseError& error) { return error.center; };
  const auto by_add = [](const PoseError& error) { return error.add; };
  const auto pose_ok = [&](const PoseError& error) {
    return error.center * 1000 <= options.most_mm &&
           error.rotation * 180 / std::numbers::pi <= options.most_deg;
  };
  const auto add_ok = [&](const PoseError& error) {
    return error.add <= options.add_fraction * object.diameter;
  };
  const std::vector<std::size_t> by_pose_rule = match(group, pose_ok, by_center);
  const std::vector<std::size_t> by_add_rule = match(group, add_ok, by_add);
  count(evaluation, group, by_pose_rule, &InstanceResult::pose_ok, counts.pose);
  count(evaluation, group, by_add_rule, &InstanceResult::add_ok, counts.add);
  std::vector<bool> shown(group.found.size());
  show(evaluation, group, by_pose_rule, shown);
  show(evaluation, group, by_add_rule, shown);
  for (std::size_t k = 0; k < shown.size(); ++k) {  // what was not matched, beside the nearest
    std::vector<std::size_t> rest(shown.size(), kNone);
    for (std::size_t i = 0; i < group.instances.size(); ++i)
      if (!evaluation.instances[group.instances[i]].found &&
          (rest[k] == kNone || group.errors[k][i].center < group.errors[k][rest[k]].center))
        rest[k] = i;
    show(evaluation, group, rest, shown);
  }
}

std::map<Key, Case> group_by_object(const GroundTruth& truth, Evaluation& evaluation) {
  std::map<Key, Case> groups;
  for (const TrueInstance& instance : truth.instances) {
    groups[{instance.scene_id, instance.im_id, instance.obj_id}].instances.push_back(
        evaluation.instances.size());
    InstanceResult result;
    result.scene_id = instance.scene_id, result.im_id = instance.im_id;
    result.obj_id = instance.obj_id;
    result.visible = instance.visible;
    result.counted = instance.visible.value_or(1) >= evaluation.options.least_visible;
    evaluation.instances.push_back(result);
  }
  return groups;
}

void add_found(const std::string& file, const GroundTruth& truth, std::map<Key, Case>& groups) {
  for (FoundInstance& found : read_results_csv(file)) {
    const auto refuse = [&](const std::string& what) {
      throw std::runtime_error(file + ":" + std::to_string(found.line) + ": " + what);
    };
    if (!truth.images.contains({found.scene_id, found.im_id}))
      refuse("scene_id " + std::to_string(found.scene_id) + ", im_id " +
             std::to_string(found.im_id) + " is no image of the ground truth");
    if (!truth.objects.contains(found.obj_id))
      refuse("obj_id " + std::to_string(found.obj_id) + " is not in models_info.json");
    groups[{found.scene_id, found.im_id, found.obj_id}].found.push_back(std::move(found));
  }
  for (auto& [key, group] : groups)  // equal scores: the row that comes first
    std::stable_sort(group.found.begin(), group.found.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
}

void add_to(Counts& sum, const Counts& part) {
  sum.instances += part.instances;
  sum.detections += part.detections;
  sum.correct += part.correct;
}

}  // namespace

Evaluation evaluate(const std::filesystem::path& dataset, const std::string& results_csv,
                    const EvaluateOptions& options) {
  const GroundTruth truth = read_ground_truth(dataset, options.split);
  Evaluation evaluation;
  evaluation.options = options;
  std::map<Key, Case> groups = group_by_object(truth, evaluation);
  add_found(results_csv, truth, groups);
  std::map<int, PoseMeter> meters;
  for (auto& [key, group] : groups) {
    const int obj_id = std::get<2>(key);
    const TrueObject& object = truth.objects.at(obj_id);
    const PoseMeter& meter = meters.try_emplace(obj_id, object).first->second;
    for (const FoundInstance& found : group.found) {
      group.errors.emplace_back();
      for (const std::size_t i : group.instances)
        group.errors.back().push_back(
            meter.measure(truth.instances[i].T_scene_model, found.T_scene_model));
    }
    judge(evaluation, group, object, evaluation.objects[obj_id]);
  }
  for (const auto& [obj_id, counts] : evaluation.objects) {
    add_to(evaluation.all.pose, counts.pose);
    add_to(evaluation.all.add, counts.add);
  }
  return evaluation;
}

}  // namespace posevote
