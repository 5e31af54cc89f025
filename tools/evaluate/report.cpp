// SPDX-License-Identifier: BSD-3-Clause
// The text of an evaluation.
#include <cmath>
#include <numbers>
#include <sstream>

#include "tools/evaluate/evaluate.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

std::string number(double value, int digits) {
  return std::isnan(value) ? "-" : format("%.*f", digits, value);
}

std::string verdict(const InstanceResult& result, const Rule& rule, double met) {
  if (std::isnan(met)) return "-";
  const std::string text = rule.average() ? number(met, 2) : met > 0 ? "ok" : "NO";
  return result.counted ? text : "(" + text + ")";
}

std::string line(const InstanceResult& result, const std::vector<Rule>& rules) {
  const auto shown = [&](double value, int digits) -> std::string {
    return result.found ? number(value, digits) : "-";
  };
  const std::string visible = result.visible ? number(100 * *result.visible, 0) : "-";
  std::string text = format("%6d %6d %6d %9s %6s %8s %7s %8s", result.scene_id, result.im_id,
                            result.obj_id, visible.c_str(), shown(result.score, 3).c_str(),
                            shown(result.errors.center * 1000, 1).c_str(),
                            shown(result.errors.rotation * 180 / std::numbers::pi, 1).c_str(),
                            shown(result.errors.add * 1000, 1).c_str());
  for (std::size_t r = 0; r < rules.size(); ++r)
    text += format(" %6s", verdict(result, rules[r], result.met[r]).c_str());
  return text + "\n";
}

std::string instance_table(const Evaluation& evaluation) {
  std::string text = format("%6s %6s %6s %9s %6s %8s %7s %8s", "scene", "image", "object",
                            "visible %", "score", "mm", "deg", "ADD mm");
  for (const Rule& rule : evaluation.rules) text += format(" %6s", rule.name.c_str());
  text += "\n";
  for (const InstanceResult& result : evaluation.instances) text += line(result, evaluation.rules);
  return text +
         "\nmm: distance of the model centres; deg: rotation error; ADD: mean distance of model "
         "points\n(symmetric objects: ADI, to the closest point; deg over their symmetries).\n";
}

std::string line(const std::string& who, const Rule& rule, const RuleResult& result) {
  const Counts& counts = result.counts;
  const std::string head = format("%-10s %-25s ", who.c_str(), rule.text.c_str());
  if (counts.instances == 0 && result.unmeasured > 0)
    return head + "    -   needs a depth image and its camera\n";
  if (rule.average())
    return head + format("%6.3f%62s over %d instances\n", counts.recall(), "", counts.instances);
  const auto best = best_f1(result.curve);
  return head +
         format("%6.3f %9.3f %6.3f %8.3f %9s %6.3f %6s %6s   %.0f of %d, %d detections\n",
                counts.recall(), counts.precision(), counts.f1(), best ? best->counts.f1() : 0.0,
                best ? format("%.4g", best->score).c_str() : "-", average_precision(result.curve),
                number(calibration_error(result), 3).c_str(),
                number(coverage_of(result).share(), 3).c_str(), counts.correct, counts.instances,
                counts.detections);
}

/// BOP's own figure, where all of its three rules were measured.
std::string bop_line(const Evaluation& evaluation) {
  double sum = 0;
  int measured = 0;
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r) {
    if (!evaluation.rules[r].average() || evaluation.all[r].counts.instances == 0) continue;
    sum += evaluation.all[r].counts.recall();
    ++measured;
  }
  if (measured < 3) return "";
  return format("%-10s %-25s %6.3f\n", "all", "AR (BOP19: mean of three)", sum / 3);
}

/// Where both are asked for: of the instances that are found by the closest points (ADD-S), those
/// that are found by the points themselves (ADD), which are the right way round.
std::string way_round(const Evaluation& evaluation) {
  std::string text;
  for (const auto& [obj_id, share] : right_way_round(evaluation))
    text += format("%-10s %-25s %6.3f   %d of %d\n",
                   obj_id == 0 ? "all" : ("object " + std::to_string(obj_id)).c_str(),
                   "ADD where ADD-S is met", share.share(), share.right, share.found);
  return text;
}

std::string notes(const Evaluation& evaluation) {
  std::string text;
  bool left_out = false;
  for (const InstanceResult& result : evaluation.instances) left_out |= !result.counted;
  if (left_out)
    text += format("In brackets: less than %g %% visible or no target, left out of the counts.\n",
                   100 * evaluation.options.least_visible);
  if (std::isfinite(evaluation.options.min_score))
    text += format("Recall, precision and F1 take detections scored %g or more.\n",
                   evaluation.options.min_score);
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r)
    if (evaluation.all[r].unmeasured > 0)
      text += format("%s: %d instances left out, which lack a depth image, a camera or faces.\n",
                     evaluation.rules[r].text.c_str(), evaluation.all[r].unmeasured);
  for (const std::string& note : evaluation.notes) text += "Note: " + note + ".\n";
  return text;
}

}  // namespace

std::string to_text(const Evaluation& evaluation, bool instances) {
  std::ostringstream text;
  if (instances) text << instance_table(evaluation);
  text << notes(evaluation);
  text << "\n"
       << format("%-10s %-25s %6s %9s %6s %8s %9s %6s %6s %6s\n", "", "rule", "recall", "precision",
                 "F1", "best F1", "at score", "AP", "ECE", "in 95%");
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r) {
    for (const auto& [obj_id, results] : evaluation.objects)
      text << line("object " + std::to_string(obj_id), evaluation.rules[r], results[r]);
    text << line("all", evaluation.rules[r], evaluation.all[r]);
  }
  text << bop_line(evaluation) << way_round(evaluation);
  return text.str();
}

}  // namespace posevote
