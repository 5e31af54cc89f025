// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/attempts.hpp"

#include <algorithm>
#include <cmath>

#include "tools/text.hpp"

namespace posevote::explain {
namespace {

constexpr double kLeastWorth = 0.05;  // a confidence below says that it is not the object

/// A little below what it reaches, in two digits.
std::string confidence_below(double confidence) {
  return format("segment_objects.min_confidence=%.2f", std::floor(100 * confidence) / 100);
}

/// The search with more of everything that a pose was lost by.
std::vector<std::string> wider_search(const std::string& step, const poses::SegmentParams& params) {
  const poses::ScheduleTerms& schedule = params.terms.schedule;
  const std::string of = "segment_objects.";
  if (step == "propose")
    return {of + format("candidates=%d", std::min(10000, 4 * params.candidates))};
  if (step == "peek") return {of + format("glances=%d", std::min(10000, 4 * schedule.glances))};
  if (step == "glance")
    return {of + format("shortlist=%d", std::min(10000, 4 * schedule.shortlist)),
            of + format("glance_points=%d", 4 * schedule.glance_points)};
  if (step == "sketch" || step == "leave out likes")
    return {of + format("sketch_points=%d", 4 * schedule.sketch_points),
            of + format("judged_per_place=%d", 4 * params.terms.pool.judged_per_place)};
  const std::string promising =
      of + format("promising=%d", std::min(10000, 5 * schedule.promising));
  const std::string finalists = of + format("finalists=%d", std::min(1000, 5 * schedule.finalists));
  if (step == "bring closer") return {promising, finalists};
  return {finalists, promising};
}

std::vector<std::string> better_votes(double resolution) {
  std::vector<std::string> settings{"cast_pairs.references=1000", "cast_rims.references=2000",
                                    "scan_octaves.radii=3"};
  if (resolution > 0) settings.push_back(format("scan_octaves.finest=%.4g", resolution / 2));
  settings.emplace_back("drop_flat.min_relief=0");
  return settings;
}

bool is_new(const Explained& one, const Taps& taps, const Detection& detection) {
  for (const auto& slot : taps.votes.slots) {
    if (slot->model->obj_id != one.obj_id) continue;
    const Alike alike(*slot->model, detection.T_scene_model);
    if (one.truth) return alike.is_near(one.truth->T_scene_model);
    const auto& before = taps.detections.items;
    return std::none_of(before.begin(), before.end(), [&](const Detection& other) {
      return other.obj_id == one.obj_id && alike.is_near(other.T_scene_model);
    });
  }
  return false;
}

}  // namespace

std::vector<std::string> settings_for(const Explained& one, const poses::SegmentParams& params,
                                      double resolution) {
  const std::optional<Standing>& at = one.truth ? one.truth : one.best;
  switch (one.verdict.cause) {
    case Cause::kOutranked:
      return wider_search(one.verdict.stage, params);
    case Cause::kRefused: {
      std::vector<std::string> settings;
      const double confidence = at ? at->sureness() : 0;
      if (one.verdict.stage == kClueNames[kExactness])
        settings.push_back(format("segment_objects.max_residual=%.3g", 2 * params.max_residual));
      if (confidence >= kLeastWorth) settings.push_back(confidence_below(confidence));
      return settings;
    }
    case Cause::kFewFeatures:
    case Cause::kNotMatched:
    case Cause::kDisagree:
      return better_votes(resolution);
    case Cause::kMoved:
      return {format("segment_objects.icp_distance=%.3g", params.icp_distance / 2)};
    case Cause::kTooNear:
      return {format("segment_objects.nms=%.3g", params.nms / 2)};
    case Cause::kInside:
      return {"segment_objects.overlap=1"};
    default:
      return {};
  }
}

std::vector<Attempt> attempt(const Explained& one, const Taps& taps) {
  std::vector<Attempt> attempts;
  for (const std::string& setting :
       settings_for(one, taps.run.segmentation(), taps.figure("resolution_m"))) {
    const std::optional<Detections> detections = taps.rerun(setting);
    if (!detections) continue;
    Attempt& made = attempts.emplace_back();
    made.setting = setting;
    made.before = taps.detections.items.size();
    made.detections = detections->items.size();
    for (const Detection& detection : detections->items) {
      if (detection.obj_id != one.obj_id || !is_new(one, taps, detection)) continue;
      made.is_found = true;
      made.confidence = std::max(made.confidence, detection.confidence);
    }
    if (made.is_found) break;
  }
  return attempts;
}

}  // namespace posevote::explain
