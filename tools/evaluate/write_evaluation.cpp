// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/write_evaluation.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

#include "tools/evaluate/calibration.hpp"
#include "tools/plot/line_chart.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string number(double value) {
  if (!std::isfinite(value)) return "";
  std::ostringstream text;
  text.precision(9);
  text << value;
  return text.str();
}

/// Calls visit(object's name, rule's place, result) for every object and for all together.
void for_each_result(
    const Evaluation& evaluation,
    const std::function<void(const std::string&, std::size_t, const RuleResult&)>& visit) {
  for (const auto& [obj_id, results] : evaluation.objects)
    for (std::size_t r = 0; r < results.size(); ++r) visit(std::to_string(obj_id), r, results[r]);
  for (std::size_t r = 0; r < evaluation.all.size(); ++r) visit("all", r, evaluation.all[r]);
}

std::string summary_csv(const Evaluation& evaluation) {
  std::string text =
      "object,rule,instances,detections,correct,recall,precision,f1,best_f1,threshold,ap,ece,in_"
      "95\n";
  for_each_result(evaluation, [&](const std::string& who, std::size_t r, const RuleResult& result) {
    const Counts& counts = result.counts;
    text += who + "," + evaluation.rules[r].name + "," + std::to_string(counts.instances) + ",";
    const auto best = best_f1(result.curve);
    const std::string recall = counts.instances > 0 ? number(counts.recall()) : "";
    if (evaluation.rules[r].average())
      text += ",," + recall + ",,,,,,,\n";
    else
      text += std::to_string(counts.detections) + "," + number(counts.correct) + "," + recall +
              "," + number(counts.precision()) + "," + number(counts.f1()) + "," +
              (best ? number(best->counts.f1()) + "," + number(best->score) : "0,") + "," +
              number(average_precision(result.curve)) + "," + number(calibration_error(result)) +
              "," + number(coverage_of(result).share()) + "\n";
  });
  return text;
}

std::string instances_csv(const Evaluation& evaluation) {
  std::string text =
      "scene_id,im_id,obj_id,visible,counted,score,center_mm,rotation_deg,add_mm,adds_mm,mssd_mm,"
      "mspd_px,"
      "vsd_tau_20mm";
  for (const Rule& rule : evaluation.rules) text += "," + rule.name;
  text += "\n";
  for (const InstanceResult& result : evaluation.instances) {
    const PairErrors& errors = result.errors;
    text += std::to_string(result.scene_id) + "," + std::to_string(result.im_id) + "," +
            std::to_string(result.obj_id) + "," + (result.visible ? number(*result.visible) : "") +
            "," + (result.counted ? "1" : "0") + "," + (result.found ? number(result.score) : "");
    for (const double value :
         {errors.center * 1000, errors.rotation * 180 / std::numbers::pi, errors.add * 1000,
          errors.adds * 1000, errors.mssd * 1000, errors.mspd, errors.vsd_2018})
      text += "," + (result.found ? number(value) : "");
    for (const double met : result.met) text += "," + number(met);
    text += "\n";
  }
  return text;
}

/// Which detections are right: `line` counts those of the results from 1.
std::string verdicts_csv(const Evaluation& evaluation) {
  std::string text = "rule,line,score,correct\n";
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r)
    for (const Verdict& verdict : evaluation.all[r].verdicts)
      text += evaluation.rules[r].name + "," + std::to_string(verdict.line) + "," +
              number(verdict.score) + "," + (verdict.correct ? "1" : "0") + "\n";
  return text;
}

std::string curve_csv(const Evaluation& evaluation) {
  std::string text = "object,rule,score,detections,correct,recall,precision,f1\n";
  for_each_result(evaluation, [&](const std::string& who, std::size_t r, const RuleResult& result) {
    for (const CurvePoint& point : result.curve)
      text += who + "," + evaluation.rules[r].name + "," + number(point.score) + "," +
              std::to_string(point.counts.detections) + "," + number(point.counts.correct) + "," +
              number(point.counts.recall()) + "," + number(point.counts.precision()) + "," +
              number(point.counts.f1()) + "\n";
  });
  return text;
}

plot::Series curve_series(const std::string& name, const RuleResult& result) {
  plot::Series series{name, {}, {}};
  for (const CurvePoint& point : result.curve) {
    series.x.push_back(point.counts.recall());
    series.y.push_back(point.counts.precision());
  }
  return series;
}

std::string curve_svg(const Evaluation& evaluation) {
  std::vector<plot::Chart> charts;
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r) {
    if (evaluation.rules[r].average()) continue;
    plot::Chart chart{evaluation.rules[r].text, "recall", "precision", {}, {}, {}, false, false};
    chart.x_range = chart.y_range = {0.0, 1.0};
    for (const auto& [obj_id, results] : evaluation.objects)
      chart.series.push_back(curve_series("object " + std::to_string(obj_id), results[r]));
    chart.series.push_back(curve_series("all", evaluation.all[r]));
    charts.push_back(chart);
  }
  return plot::to_svg(charts);
}

std::vector<NamedCalibration> calibrations_of(const Evaluation& evaluation) {
  std::vector<NamedCalibration> all;
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r)
    if (!evaluation.rules[r].average())
      if (const auto made = calibrate(evaluation.all[r].verdicts))
        all.push_back({evaluation.rules[r].name, *made});
  return all;
}

std::string visibility_svg(const Evaluation& evaluation) {
  plot::Chart chart{"Recall by visibility", "visible [%]", "recall", {}, {}, {}, false, false};
  chart.x_range = {0.0, 100.0};
  chart.y_range = {0.0, 1.0};
  for (std::size_t r = 0; r < evaluation.rules.size(); ++r) {
    plot::Series series{evaluation.rules[r].text, {}, {}};
    for (std::size_t bin = 0; bin < 10; ++bin) {
      const VisibleBin& place = evaluation.all[r].by_visibility[bin];
      if (place.instances == 0) continue;
      series.x.push_back(10 * static_cast<double>(bin) + 5);
      series.y.push_back(place.correct / place.instances);
    }
    chart.series.push_back(series);
  }
  return plot::to_svg(chart);
}

ordered_json to_json(const RuleResult& result, const Rule& rule) {
  const Counts& counts = result.counts;
  ordered_json json{{"rule", rule.name},
                    {"definition", rule.text},
                    {"instances", counts.instances},
                    {"unmeasured", result.unmeasured}};
  json["recall"] = counts.instances > 0 ? ordered_json(counts.recall()) : ordered_json();
  if (!rule.average()) {
    json["detections"] = counts.detections;
    json["correct"] = counts.correct;
    json["precision"] = counts.precision();
    json["f1"] = counts.f1();
    const auto best = best_f1(result.curve);
    json["best_f1"] = best ? best->counts.f1() : 0;
    json["threshold"] = best ? ordered_json(best->score) : ordered_json();
    json["ap"] = average_precision(result.curve);
    const double ece = calibration_error(result);
    json["ece"] = std::isnan(ece) ? ordered_json() : ordered_json(ece);
    if (const Coverage coverage = coverage_of(result); coverage.known > 0) {
      json["with_covariance"] = coverage.known;
      json["in_95"] = coverage.share();
    }
  }
  for (std::size_t bin = 0; bin < 10; ++bin)
    if (const VisibleBin& place = result.by_visibility[bin]; place.instances > 0)
      json["by_visibility"].push_back({{"from", 0.1 * static_cast<double>(bin)},
                                       {"instances", place.instances},
                                       {"recall", place.correct / place.instances}});
  return json;
}

}  // namespace

ordered_json to_json(const Evaluation& evaluation) {
  ordered_json json;
  json["least_visible"] = evaluation.options.least_visible;
  if (std::isfinite(evaluation.options.min_score)) json["min_score"] = evaluation.options.min_score;
  if (evaluation.options.top > 0) json["top"] = evaluation.options.top;
  json["notes"] = evaluation.notes;
  for (const auto& [obj_id, results] : evaluation.objects) {
    ordered_json object{{"obj_id", obj_id}, {"rules", ordered_json::array()}};
    const auto name = evaluation.names.find(obj_id);
    if (name != evaluation.names.end()) object["model"] = name->second;
    for (std::size_t r = 0; r < results.size(); ++r)
      object["rules"].push_back(to_json(results[r], evaluation.rules[r]));
    json["objects"].push_back(std::move(object));
  }
  for (std::size_t r = 0; r < evaluation.all.size(); ++r)
    json["all"].push_back(to_json(evaluation.all[r], evaluation.rules[r]));
  return json;
}

void write_evaluation(const Evaluation& evaluation, const fs::path& folder) {
  fs::create_directories(folder);
  write_text(folder / "evaluation.json", to_json(evaluation).dump(2) + "\n");
  write_text(folder / "evaluation.csv", summary_csv(evaluation));
  write_text(folder / "instances.csv", instances_csv(evaluation));
  write_text(folder / "verdicts.csv", verdicts_csv(evaluation));
  write_text(folder / "precision_recall.csv", curve_csv(evaluation));
  write_text(folder / "precision_recall.svg", curve_svg(evaluation));
  write_text(folder / "reliability.csv", reliability_csv(calibrations_of(evaluation)));
  write_text(folder / "reliability.svg", reliability_svg(calibrations_of(evaluation)));
  write_text(folder / "recall_visibility.svg", visibility_svg(evaluation));
}

}  // namespace posevote
