// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/sentences.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/text.hpp"

namespace posevote::explain {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

int percent(double share) { return static_cast<int>(std::lround(100 * share)); }

/// What a clue says when it is against a pose.
const char* meaning_of(const std::string& clue) {
  constexpr auto kMeanings = std::to_array<const char*>(
      {"the sensor saw something else where the object should be",
       "what is seen of it is nearly flat", "little of its outline is met by the scan's",
       "the scan goes on where the object should end", "few of the features on it voted for it",
       "other places have as many votes", "it lies off by more than the scan's other instances",
       "few of its points are seen", "its holes, slots and edges are not met by the scan's",
       "the scan has a surface where the object has holes",
       "much of it is hidden, and the rest is flat", "much of it would lie in the ground",
       "much of it would lie beside the image, and other places have as many votes",
       "of the things in the scan few are known, so that it may be another's look-alike",
       "another of its kind is there, and the scan's other things are there once each"});
  static_assert(kMeanings.size() == kClueCount);
  const auto at = std::find(kClueNames.begin(), kClueNames.end(), clue);
  if (at == kClueNames.end()) return "its colours are not those that the camera saw";
  return kMeanings[static_cast<std::size_t>(at - kClueNames.begin())];
}

std::string seen_sentence(const Standing& at) {
  const Seen& seen = at.seen;
  std::string text = format("Seen: of its points that face the sensor %d %% lie on the scan",
                            percent(seen.supported));
  const auto add = [&](double share, const char* what) {
    if (percent(share) > 0) text += format(", %d %% ", percent(share)) + what;
  };
  add(seen.hidden, "are hidden behind something");
  add(seen.outside, "lie beside the image");
  add(seen.unmeasured, "were not measured");
  add(seen.contradicted, "were seen through");
  add(seen.mismatched, "met another surface");
  return text + format(" (%zu points of the scan, at %.2f m).", seen.scan_points, at.range);
}

std::string features_sentence(const Standing& at) {
  std::string text = format("Features: %zu of the scan's lie on it, %zu of them matched to it",
                            at.features, at.matched);
  if (at.matched_other > 0) text += format(", %zu to ", at.matched_other) + at.other;
  return text + format("; %zu correspondences and %zu point-pair votes agree with the pose.",
                       at.agreeing, at.pairs);
}

std::string votes_sentence(const Standing& at) {
  if (at.highest == 0) return "Votes: the object has none in this scan.";
  const std::string density =
      format("Votes: density %.1f there, %.1f at its highest peak", at.density, at.highest);
  if (at.rank == 0) return density + format("; none of its %zu peaks lies near.", at.peaks);
  return density + format("; peak %zu of %zu.", at.rank, at.peaks);
}

std::string way_sentence(const Standing& at) {
  std::string text;
  for (const Place& place : at.way) {
    if (place.place == 0)
      return (text.empty() ? "Search: " : text + "; ") + "lost at '" + place.step + "'" +
             format(" (of %zu candidates).", place.of);
    text += (text.empty() ? "Search: " : ", ") + place.step +
            format(" %zu of %zu", place.place, place.of);
  }
  return text.empty() ? "Search: there were no proposals." : text + ".";
}

/// The worst of what is against a pose, in log odds.
std::string against(const Judged& judged) {
  constexpr std::size_t kMost = 3;
  std::string text;
  const auto reasons = judged.reasons();
  for (std::size_t i = 0; i < kMost && reasons[i].second > 0.3; ++i)
    text += (i > 0 ? "; " : "") + reasons[i].first + format(" (-%.1f): ", reasons[i].second) +
            meaning_of(reasons[i].first);
  return text;
}

std::string judged_sentence(const Standing& at, const Case& of) {
  std::string text = format("Judged: confidence %.2f (asked for: %.2f), score %.2f (%.2f)",
                            at.judged.confidence, of.min_confidence, at.judged.score, of.min_score);
  if (at.taken > 0.1)
    text += format("; of what other instances leave %.2f, ", at.left.confidence) + at.taker +
            format(" has %d %% of its points", percent(at.taken));
  const std::string worst = against(at.judged);
  return text + (worst.empty() ? "." : ". Against it, in log odds: " + worst + ".");
}

std::string size_sentence(const Case& of) {
  std::string text =
      format("its size: the model is %.4g m across, the scan %.4g m", of.diagonal, of.scan_size);
  if (of.usual_size > 0) text += format(", other models %.4g m", of.usual_size);
  return text + "; its file is in another unit (--model-unit, load_models.unit)";
}

std::string unseen_sentence(const std::string& detail) {
  if (detail == "hidden") return "it is hidden behind something else; no setting helps";
  if (detail == "outside") return "it lies beside the image; no setting helps";
  return "the sensor measured next to nothing of it; no setting helps";
}

std::string refused_sentence(const Standing& at, const Verdict& verdict, const Case& of) {
  std::string text =
      "it was judged, and refused: " +
      format("confidence %.2f of %.2f", deciding(at, of).confidence, of.min_confidence);
  return text + "; most of all " + meaning_of(verdict.stage);
}

std::string cause_of(const Verdict& verdict, const Case& of) {
  const Standing at = of.pose.value_or(Standing());
  switch (verdict.cause) {
    case Cause::kFound:
      return "";
    case Cause::kScanFailed:
      return "the scan failed in " + verdict.stage + ": " + verdict.detail;
    case Cause::kLeftOut:
      return "the model could not be used: " + verdict.detail;
    case Cause::kUnit:
      return size_sentence(of);
    case Cause::kNotSeen:
      return unseen_sentence(verdict.detail);
    case Cause::kFewFeatures:
      return format(
          "the scan has %zu features on it: it is too coarse (%.2g mm) for an object of "
          "%.3g mm, or hardly shows it",
          at.features, 1000 * of.resolution, 1000 * of.diagonal);
    case Cause::kNotMatched:
      return format("of %zu features on it %zu are matched to it", at.features, at.matched) +
             (at.matched_other > 0 ? format(", %zu to ", at.matched_other) + at.other : "");
    case Cause::kDisagree:
      return format(
          "%zu features are matched to it, but %zu correspondences and %zu point pairs "
          "agree on the pose",
          at.matched, at.agreeing, at.pairs);
    case Cause::kOutranked:
      return "other poses went first, it was lost at '" + verdict.stage +
             format("'; looked at closely its confidence is %.2f", at.judged.confidence);
    case Cause::kMoved:
      if (at.stayed)
        return format(
            "what was refined near it ended beside it and was refused; the pose itself "
            "has a confidence of %.2f",
            at.left.confidence);
      return format("ICP carries it away, by %.1f mm and %.0f deg", 1000 * at.moved,
                    kDegrees * at.turned);
    case Cause::kTaken:
      return verdict.stage + format(" took %d %% of its points: confidence %.2f without it, %.2f",
                                    percent(at.taken), at.judged.confidence, at.left.confidence);
    case Cause::kTooNear:
      return format(
          "one of its kind was found %.1f mm from it, nearer than segment_objects.nms "
          "allows (%.1f mm)",
          1000 * at.near_same.value_or(0), 1000 * of.nms_radius);
    case Cause::kInside:
      return format(
          "%d %% of its surface lies in instances that were found, more than "
          "segment_objects.overlap allows (%d %%): bodies are solid",
          percent(at.inside), percent(of.overlap));
    case Cause::kRefused:
      return refused_sentence(at, verdict, of);
    case Cause::kAbsent:
      return "by the true poses there is none of it in this scan";
    case Cause::kNoTrace:
      return format(
                 "no trace of it: of %zu matches in the scan no pose gathers enough that the "
                 "scan bears out; it is not there, hidden, or described otherwise (with its "
                 "true pose, --truth or --dataset, it is told which)",
                 of.matches) +
             (of.pose
                  ? format(". Were it where the best candidate is, confidence %.2f, most of all ",
                           at.likelihood()) +
                        meaning_of(verdict.stage)
                  : "");
  }
  return "";
}

std::string conclusion(const Verdict& verdict, const Case& of) {
  const std::string cause = cause_of(verdict, of);
  if (cause.empty()) return "Found.";
  return std::string(of.is_true || !of.pose ? "Cause: " : "Probable cause: ") + cause + ".";
}

void add_standing(const Standing& at, const Case& of, std::vector<std::string>& out) {
  out.push_back(seen_sentence(at));
  out.push_back(features_sentence(at));
  out.push_back(votes_sentence(at));
  out.push_back(way_sentence(at));
  out.push_back(judged_sentence(at, of));
  if (!at.stayed)
    out.push_back(format("ICP carries it away from there: by %.1f mm and %.0f deg.",
                         1000 * at.moved, kDegrees * at.turned));
}

std::string place_of(const Standing& at) {
  const Eigen::Vector3d t = at.T_scene_model.translation();
  return format("(%.3f, %.3f, %.3f) m", t.x(), t.y(), t.z());
}

std::string attempt_sentence(const Attempt& attempt) {
  if (!attempt.is_found) return "Tried " + attempt.setting + ": does not find it.";
  return "Tried " + attempt.setting +
         format(": finds it, confidence %.2f; detections in the scan: %zu, without it %zu.",
                attempt.confidence, attempt.detections, attempt.before);
}

}  // namespace

std::vector<std::string> scan_sentences(const graph::Figures& figures,
                                        const std::vector<std::string>& warnings) {
  std::vector<std::string> out;
  const auto value = [&](const char* name) {
    const auto at = figures.find(name);
    return at == figures.end() || at->second.empty() ? 0.0 : at->second.front();
  };
  if (value("spacing_m") > 0)
    out.push_back(
        format("The scan: points %.2f mm apart, noise %.2f mm at %.2f m; it resolves "
               "%.2f mm, and tilts normals by %.1f deg.",
               1000 * value("spacing_m"), 1000 * value("noise_m"), value("range_m"),
               1000 * value("resolution_m"), value("normal_tilt_deg")));
  for (const std::string& warning : warnings) out.push_back("Warning: " + warning + ".");
  return out;
}

std::vector<std::string> sentences(const Explained& one, const Case& of) {
  std::vector<std::string> out{conclusion(one.verdict, of)};
  if (one.best) {
    out.push_back((one.is_found      ? "Found at "
                   : one.is_one_more ? "A candidate is at "
                                     : "The best candidate is at ") +
                  place_of(*one.best) +
                  (!one.truth         ? "."
                   : one.best_is_true ? ", where the object is."
                                      : ", where the object is not."));
    if (one.is_found || !one.truth || !one.best_is_true) add_standing(*one.best, of, out);
  }
  if (one.truth && !one.is_found) {
    out.push_back("The true pose is at " + place_of(*one.truth) + ".");
    add_standing(*one.truth, of, out);
  }
  for (const Attempt& attempt : one.attempts) out.push_back(attempt_sentence(attempt));
  return out;
}

std::string to_text(const Explanation& explanation) {
  std::string text = explanation.frame.name + "\n";
  for (const std::string& sentence : explanation.sentences) text += "  " + sentence + "\n";
  for (const Explained& one : explanation.objects) {
    text += "\n" + one.model + format(" (obj_id %d): ", one.obj_id) +
            (one.is_found      ? "found"
             : one.is_one_more ? "perhaps one more"
                               : "not found") +
            "\n";
    for (const std::string& sentence : one.sentences) text += "  " + sentence + "\n";
  }
  return text;
}

}  // namespace posevote::explain
