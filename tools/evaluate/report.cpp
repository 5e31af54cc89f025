// SPDX-License-Identifier: BSD-3-Clause
// The text of an evaluation.
#include <cstdio>
#include <sstream>

#include "tools/evaluate/evaluate.hpp"

namespace posevote {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string number(double value, int digits) { return format("%.*f", digits, value); }

std::string line(const InstanceResult& result) {
  const auto shown = [&](double value, int digits) -> std::string {
    return result.found ? number(value, digits) : "-";
  };
  const std::string visible = result.visible ? number(100 * *result.visible, 0) : "-";
  const auto verdict = [&](bool ok) {
    return ok ? (result.counted ? "ok" : "(ok)") : (result.counted ? "NO" : "(no)");
  };
  return format("%6d %6d %6d %9s %6s %8s %7s %8s %6s %6s\n", result.scene_id, result.im_id,
                result.obj_id, visible.c_str(), shown(result.score, 3).c_str(),
                shown(result.mm, 1).c_str(), shown(result.deg, 1).c_str(),
                shown(result.add_mm, 1).c_str(), verdict(result.pose_ok), verdict(result.add_ok));
}

std::string line(const std::string& who, const std::string& rule, const Counts& counts) {
  return format("%-10s %-22s %6.3f %10.3f %6.3f   %d of %d instances, %d detections\n", who.c_str(),
                rule.c_str(), counts.recall(), counts.precision(), counts.f1(), counts.correct,
                counts.instances, counts.detections);
}

std::string lines(const std::string& who, const RuleCounts& counts,
                  const EvaluateOptions& options) {
  const std::string pose = format("pose %g mm, %g deg", options.most_mm, options.most_deg);
  const std::string add = format("ADD/ADI %g diameter", options.add_fraction);
  return line(who, pose, counts.pose) + line(who, add, counts.add);
}

}  // namespace

std::string to_text(const Evaluation& evaluation) {
  const EvaluateOptions& options = evaluation.options;
  std::ostringstream text;
  text << format("%6s %6s %6s %9s %6s %8s %7s %8s %6s %6s\n", "scene", "image", "object",
                 "visible %", "score", "mm", "deg", "ADD mm", "pose", "ADD");
  bool left_out = false;
  for (const InstanceResult& result : evaluation.instances) {
    text << line(result);
    left_out = left_out || !result.counted;
  }
  text << "\nmm: distance of the model centres; deg: rotation error; ADD: mean distance of model "
          "points\n(symmetric objects: ADI, to the closest point; deg over their symmetries).\n";
  if (left_out)
    text << format("In brackets: less than %g %% visible, left out of the counts.\n",
                   100 * options.least_visible);
  text << "\n" << format("%-10s %-22s %6s %10s %6s\n", "", "rule", "recall", "precision", "F1");
  for (const auto& [obj_id, counts] : evaluation.objects)
    text << lines("object " + std::to_string(obj_id), counts, options);
  text << lines("all", evaluation.all, options);
  return text.str();
}

}  // namespace posevote
