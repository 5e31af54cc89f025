// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/judge_image.hpp"

#include <algorithm>

#include "tools/evaluate/surface_discrepancy.hpp"

namespace posevote {
namespace {

constexpr double kDelta = 0.015, kTau2018 = 0.02;  // [m]

using Errors = std::vector<std::vector<PairErrors>>;  ///< [found][instance]

/// Measures pairs in one image; loads its depth image once, where a rule needs it.
class ImageMeter {
 public:
  ImageMeter(const layouts::TrueImage& image, const std::vector<Rule>& rules) : image_(image) {
    const bool usable = image.camera && !image.depth.empty();
    for (const Rule& rule : rules) {
      needs_add_ |= rule.name == "add" || rule.name == "adi15";
      needs_adds_ |= rule.name == "adds";
      needs_mssd_ |= rule.name == "mssd";
      needs_mspd_ |= usable && rule.needs == Needs::camera;
      needs_vsd_ |= usable && rule.needs == Needs::depth;
    }
    if (needs_mspd_ || needs_vsd_) measured_ = read_range_image(image);
  }

  bool can(const Rule& rule, const layouts::TrueObject& object) const {
    const bool usable = image_.camera && !image_.depth.empty();
    if (rule.needs == Needs::depth)
      return usable && (object.faces.rows() > 0 || object.points.rows() == 0);
    return rule.needs == Needs::poses || usable;
  }

  Errors measure(const Case& group, const layouts::TrueObject& object,
                 const PoseMeter& meter) const {
    std::vector<RangeImage> of_true, of_found;
    if (needs_vsd_ && object.faces.rows() > 0) {
      for (const layouts::TrueInstance* instance : group.instances)
        of_true.push_back(seen(object, instance->T_scene_model));
      for (const FoundInstance* found : group.found)
        of_found.push_back(seen(object, found->T_scene_model));
    }
    Errors errors(group.found.size());
    for (std::size_t k = 0; k < group.found.size(); ++k)
      for (std::size_t i = 0; i < group.instances.size(); ++i) {
        errors[k].push_back(
            pair(meter, group.instances[i]->T_scene_model, group.found[k]->T_scene_model));
        if (group.found[k]->covariance)
          errors[k].back().surprise =
              meter.surprise(group.instances[i]->T_scene_model, group.found[k]->T_scene_model,
                             *group.found[k]->covariance);
        if (!of_true.empty()) add_vsd(object, of_true[i], of_found[k], errors[k].back());
      }
    return errors;
  }

 private:
  RangeImage seen(const layouts::TrueObject& object, const Eigen::Isometry3d& T_scene_model) const {
    return render(object, T_scene_model, *image_.camera, measured_.width, measured_.height);
  }

  PairErrors pair(const PoseMeter& meter, const Eigen::Isometry3d& T_true,
                  const Eigen::Isometry3d& T_found) const {
    PairErrors errors;
    errors.center = meter.center(T_true, T_found);
    errors.rotation = meter.rotation(T_true, T_found);
    if (needs_add_) errors.add = meter.add(T_true, T_found);
    if (needs_adds_) errors.adds = meter.adds(T_true, T_found);
    if (needs_mssd_) errors.mssd = meter.mssd(T_true, T_found);
    if (needs_mspd_)
      errors.mspd = meter.mspd(T_true, T_found, *image_.camera) * 640 / measured_.width;
    return errors;
  }

  void add_vsd(const layouts::TrueObject& object, const RangeImage& of_true,
               const RangeImage& of_found, PairErrors& errors) const {
    std::vector<double> taus;
    for (int i = 1; i <= 10; ++i) taus.push_back(0.05 * i * object.diameter);
    errors.vsd_steps =
        surface_discrepancy(measured_, of_true, of_found, kDelta, Holes::visible, taus);
    errors.vsd_2018 =
        surface_discrepancy(measured_, of_true, of_found, kDelta, Holes::hidden, {kTau2018})[0];
  }

  const layouts::TrueImage& image_;
  bool needs_add_ = false, needs_adds_ = false, needs_mssd_ = false, needs_mspd_ = false,
       needs_vsd_ = false;
  RangeImage measured_;
};

/// For each of the first `count` detections, the place of its instance, or kNone.
std::vector<std::size_t> match(const Errors& errors, std::size_t count, const Condition& condition,
                               double diameter) {
  std::vector<std::size_t> matched;
  std::vector<bool> taken(errors.empty() ? 0 : errors[0].size());
  for (std::size_t k = 0; k < std::min(count, errors.size()); ++k) {
    std::size_t best = kNone;
    for (std::size_t i = 0; i < taken.size(); ++i)
      if (!taken[i] && condition.accepts(errors[k][i], diameter) &&
          (best == kNone || condition.order(errors[k][i]) < condition.order(errors[k][best])))
        best = i;
    if (best != kNone) taken[best] = true;
    matched.push_back(best);
  }
  return matched;
}

/// Shows the pairs of `matched` with their instances, where neither side is shown already.
void show(const Case& group, const Errors& errors, const std::vector<std::size_t>& matched,
          std::vector<bool>& shown) {
  for (std::size_t k = 0; k < matched.size(); ++k) {
    if (matched[k] == kNone || shown[k]) continue;
    InstanceResult& result = *group.results[matched[k]];
    if (result.found) continue;
    shown[k] = result.found = true;
    result.score = group.found[k]->score;
    result.errors = errors[k][matched[k]];
  }
}

/// What no rule matched is shown beside the nearest instance that is left.
void show_rest(const Case& group, const Errors& errors, std::vector<bool>& shown) {
  for (std::size_t k = 0; k < shown.size(); ++k) {
    std::vector<std::size_t> rest(shown.size(), kNone);
    for (std::size_t i = 0; i < group.results.size(); ++i)
      if (!group.results[i]->found &&
          (rest[k] == kNone || errors[k][i].center < errors[k][rest[k]].center))
        rest[k] = i;
    show(group, errors, rest, shown);
  }
}

/// A detection of an instance that is not counted is neither right nor wrong.
std::vector<Verdict> verdicts(const Rule& rule, const Case& group, const Errors& errors,
                              const std::vector<std::size_t>& matched) {
  std::vector<Verdict> list;
  for (std::size_t k = 0; k < matched.size(); ++k) {
    const bool correct = matched[k] != kNone;
    if (correct && !group.results[matched[k]]->counted) continue;
    const FoundInstance& found = *group.found[k];
    list.push_back(
        {found.score, correct, found.line, correct ? errors[k][matched[k]].surprise : kUnknown});
    if (!rule.takes_look_alikes) list.back().probability = found.pose_confidence;
  }
  return list;
}

/// Judges by one rule: instances' `met`, and what counts of the detections.
std::vector<Verdict> apply(const Rule& rule, std::size_t place, const Case& group,
                           const Errors& errors, double diameter, double min_score,
                           std::vector<bool>& shown) {
  const auto counted = static_cast<std::size_t>(
      std::count_if(group.results.begin(), group.results.end(),
                    [](const InstanceResult* result) { return result->counted; }));
  std::vector<Verdict> list;
  for (InstanceResult* result : group.results) result->met[place] = 0;
  for (const Condition& condition : rule.conditions) {
    const std::vector<std::size_t> matched =
        match(errors, rule.average() ? counted : errors.size(), condition, diameter);
    for (std::size_t k = 0; k < matched.size(); ++k)
      if (matched[k] != kNone && group.found[k]->score >= min_score)
        group.results[matched[k]]->met[place] += 1 / static_cast<double>(rule.conditions.size());
    if (rule.average()) continue;
    show(group, errors, matched, shown);
    list = verdicts(rule, group, errors, matched);
  }
  return list;
}

}  // namespace

std::vector<CaseResult> judge_image(const layouts::GroundTruth& truth, const layouts::ImageKey& key,
                                    std::map<int, Case>& cases,
                                    const std::map<int, PoseMeter>& meters,
                                    const std::vector<Rule>& rules, double min_score) {
  const ImageMeter image(truth.images.at(key), rules);
  std::vector<CaseResult> results;
  for (auto& [obj_id, group] : cases) {
    const layouts::TrueObject& object = truth.objects.at(obj_id);
    CaseResult result{obj_id, {}, {}};
    Errors errors(group.found.size());
    if (!group.instances.empty()) errors = image.measure(group, object, meters.at(obj_id));
    std::vector<bool> shown(group.found.size());
    for (std::size_t r = 0; r < rules.size(); ++r) {
      const bool can = image.can(rules[r], object);
      result.verdicts.emplace_back();
      result.unmeasured.push_back(0);
      if (can)
        result.verdicts[r] = apply(rules[r], r, group, errors, object.diameter, min_score, shown);
      for (InstanceResult* instance : group.results) {
        if (can) continue;
        instance->met[r] = kUnknown;
        result.unmeasured[r] += instance->counted;
      }
    }
    show_rest(group, errors, shown);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace posevote
