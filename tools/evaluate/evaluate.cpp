// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "graph/parallel.hpp"
#include "tools/evaluate/calibration.hpp"
#include "tools/evaluate/judge_image.hpp"
#include "tools/progress/progress.hpp"

namespace posevote {
namespace {

using Cases = std::map<layouts::ImageKey, std::map<int, Case>>;

Cases group_instances(const layouts::GroundTruth& truth, Evaluation& evaluation) {
  for (const layouts::TrueInstance& instance : truth.instances) {
    InstanceResult result;
    result.scene_id = instance.scene_id, result.im_id = instance.im_id;
    result.obj_id = instance.obj_id;
    result.visible = instance.visible;
    result.met.resize(evaluation.rules.size());
    evaluation.instances.push_back(std::move(result));
  }
  const std::vector<bool> count = which_count(truth, evaluation.options.least_visible);
  for (std::size_t i = 0; i < count.size(); ++i) evaluation.instances[i].counted = count[i];
  Cases cases;
  for (std::size_t i = 0; i < truth.instances.size(); ++i) {
    const layouts::TrueInstance& instance = truth.instances[i];
    Case& group = cases[{instance.scene_id, instance.im_id}][instance.obj_id];
    group.instances.push_back(&instance);
    group.results.push_back(&evaluation.instances[i]);
  }
  return cases;
}

/// Refuses a row that cannot be of this data set; false: of an image that is not judged.
bool check_row(const FoundInstance& found, const layouts::GroundTruth& truth,
               const std::string& file) {
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(file + ":" + std::to_string(found.line) + ": " + what);
  };
  const layouts::ImageKey key{found.scene_id, found.im_id};
  if (truth.left_out.contains(key)) return false;
  if (!truth.images.contains(key))
    refuse("scene_id " + std::to_string(found.scene_id) + ", im_id " + std::to_string(found.im_id) +
           " is no image of the ground truth");
  if (!truth.objects.contains(found.obj_id))
    refuse("obj_id " + std::to_string(found.obj_id) + " is no object of the data set");
  return true;
}

void add_found(const std::vector<FoundInstance>& rows, const layouts::GroundTruth& truth,
               const EvaluateOptions& options, Cases& cases) {
  for (const FoundInstance& found : rows)
    if (check_row(found, truth, options.results))
      cases[{found.scene_id, found.im_id}][found.obj_id].found.push_back(&found);
  for (auto& [key, objects] : cases)
    for (auto& [obj_id, group] : objects) {  // equal scores: the row that comes first
      std::stable_sort(group.found.begin(), group.found.end(),
                       [](const auto* a, const auto* b) { return a->score > b->score; });
      if (options.top > 0 && group.found.size() > std::size_t(options.top))
        group.found.resize(std::size_t(options.top));
    }
}

/// The counts of a rule over some instances and the verdicts on their detections.
struct Sum {
  std::vector<const InstanceResult*> instances;
  std::vector<Verdict> verdicts;
  int unmeasured = 0;
};

RuleResult summarise(const Sum& sum, std::size_t rule, const Evaluation& evaluation) {
  RuleResult result;
  result.unmeasured = sum.unmeasured;
  for (const InstanceResult* instance : sum.instances) {
    const double met = instance->met[rule];
    if (!instance->counted || std::isnan(met)) continue;
    ++result.counts.instances;
    result.counts.correct += met;
    if (!instance->visible) continue;
    const double bin = std::floor(std::clamp(*instance->visible, 0.0, 0.999999) * 10);
    VisibleBin& place = result.by_visibility[static_cast<std::size_t>(bin)];
    ++place.instances;
    place.correct += met;
  }
  for (const Verdict& verdict : sum.verdicts)
    result.counts.detections += verdict.score >= evaluation.options.min_score;
  result.verdicts = sum.verdicts;
  if (!evaluation.rules[rule].average())
    result.curve = make_curve(sum.verdicts, result.counts.instances);
  return result;
}

void summarise_all(const std::vector<std::vector<CaseResult>>& images, Evaluation& evaluation) {
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r) {
    std::map<int, Sum> sums;
    Sum all;
    for (const InstanceResult& instance : evaluation.instances) {
      sums[instance.obj_id].instances.push_back(&instance);
      all.instances.push_back(&instance);
    }
    for (const auto& results : images)
      for (const CaseResult& result : results)
        for (Sum* sum : {&sums[result.obj_id], &all}) {
          sum->verdicts.insert(sum->verdicts.end(), result.verdicts[r].begin(),
                               result.verdicts[r].end());
          sum->unmeasured += result.unmeasured[r];
        }
    for (const auto& [obj_id, sum] : sums)
      evaluation.objects[obj_id].push_back(summarise(sum, r, evaluation));
    evaluation.all.push_back(summarise(all, r, evaluation));
  }
}

}  // namespace

double calibration_error(const RuleResult& result) {
  const auto calibration = calibrate(result.verdicts);
  return calibration && calibration->count > 0 ? calibration->error : kUnknown;
}

std::map<int, WayRound> right_way_round(const Evaluation& evaluation) {
  const auto place_of = [&](const std::string& name) {
    const auto at = std::find_if(evaluation.rules.begin(), evaluation.rules.end(),
                                 [&](const Rule& rule) { return rule.name == name; });
    return static_cast<std::size_t>(at - evaluation.rules.begin());
  };
  const std::size_t add = place_of("add"), adds = place_of("adds");
  std::map<int, WayRound> objects;
  if (std::max(add, adds) == evaluation.rules.size()) return objects;
  for (const InstanceResult& instance : evaluation.instances) {
    if (!instance.counted || !(instance.met[adds] > 0)) continue;
    for (const int obj_id : {0, instance.obj_id}) {
      ++objects[obj_id].found;
      objects[obj_id].right += instance.met[add] > 0;
    }
  }
  return objects;
}

Coverage coverage_of(const RuleResult& result) {
  constexpr double k95 = 12.592;  // chi-square of six degrees of freedom
  Coverage coverage;
  for (const Verdict& verdict : result.verdicts) {
    if (std::isnan(verdict.surprise)) continue;
    ++coverage.known;
    coverage.within += verdict.surprise <= k95;
  }
  return coverage;
}

std::vector<bool> which_count(const layouts::GroundTruth& truth, double least_visible) {
  const auto visible = [&truth](std::size_t i) { return truth.instances[i].visible.value_or(1); };
  std::vector<bool> count(truth.instances.size());
  for (std::size_t i = 0; i < count.size(); ++i) count[i] = visible(i) >= least_visible;
  if (truth.targets.empty()) return count;
  std::map<std::tuple<int, int, int>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const layouts::TrueInstance& one = truth.instances[i];
    groups[{one.scene_id, one.im_id, one.obj_id}].push_back(i);
  }
  for (auto& [key, group] : groups) {
    std::stable_sort(group.begin(), group.end(),
                     [&visible](std::size_t a, std::size_t b) { return visible(a) > visible(b); });
    const auto target = truth.targets.find(key);
    const int wanted = target == truth.targets.end() ? 0 : target->second;
    for (std::size_t i = 0; i < group.size(); ++i) count[group[i]] = static_cast<int>(i) < wanted;
  }
  return count;
}

Evaluation evaluate(const layouts::GroundTruth& truth, const std::vector<FoundInstance>& found,
                    const EvaluateOptions& options) {
  Evaluation evaluation;
  evaluation.options = options;
  evaluation.rules = choose_rules(options.rules);
  evaluation.notes = truth.notes;
  Cases cases = group_instances(truth, evaluation);
  add_found(found, truth, options, cases);
  std::map<int, PoseMeter> meters;
  for (const auto& [obj_id, object] : truth.objects) {
    evaluation.names[obj_id] = object.name;
    if (object.points.rows() > 0) meters.try_emplace(obj_id, object);
  }
  std::vector<Cases::value_type*> images;
  for (auto& image : cases) images.push_back(&image);
  std::vector<std::vector<CaseResult>> results(images.size());
  {
    Progress progress({"images judged", images.size()});
    graph::parallel_for(images.size(), 1, [&](std::size_t i) {
      results[i] = judge_image(truth, images[i]->first, images[i]->second, meters, evaluation.rules,
                               options.min_score);
      progress.advance();
    });
  }
  summarise_all(results, evaluation);
  return evaluation;
}

}  // namespace posevote
