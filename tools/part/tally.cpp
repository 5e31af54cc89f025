// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/experiment/experiment.hpp"
#include "tools/part/part.hpp"
#include "tools/plot/line_chart.hpp"
#include "tools/text.hpp"

namespace posevote::part {
namespace {

/// Steps of visibility, from full view down; an instance belongs to the first that it reaches.
constexpr double kSteps[] = {0.8, 0.6, 0.4, 0.2, 0.1};
constexpr double kWanted = 0.95;  ///< recall
constexpr int kFewest = 10;       ///< instances that a rate is believed of

struct Count {
  int found = 0, instances = 0;
  void add(const Outcome& outcome) { ++instances, found += outcome.found ? 1 : 0; }
  double recall() const { return instances > 0 ? static_cast<double>(found) / instances : 0; }
};

int step_of(double visible) {
  int step = 0;
  while (step + 1 < static_cast<int>(std::size(kSteps)) && visible < kSteps[step]) ++step;
  return step;
}

Count count(const Tally& tally, int obj_id, double range, int step) {
  Count count;
  for (const Outcome& outcome : tally.outcomes)
    if ((obj_id == 0 || outcome.obj_id == obj_id) && outcome.range == range &&
        (step < 0 || step_of(outcome.visible) == step))
      count.add(outcome);
  return count;
}

std::string step_name(int step) {
  const auto i = static_cast<std::size_t>(step);
  return format("%.0f-%.0f %%", 100 * kSteps[i], i == 0 ? 100.0 : 100 * kSteps[i - 1]);
}

std::string cell(const Count& count) {
  if (count.instances == 0) return "-";
  return format("%.2f (%d/%d)", count.recall(), count.found, count.instances);
}

/// Recall of one part, a row for each range.
std::string table(const Tally& tally, int obj_id) {
  std::string text = format("%-10s %14s", "range", "all");
  for (int step = 0; step < static_cast<int>(std::size(kSteps)); ++step)
    text += format(" %14s", step_name(step).c_str());
  for (const double range : tally.ranges) {
    text += format("\n%-10s %14s", format("%g m", range).c_str(),
                   cell(count(tally, obj_id, range, -1)).c_str());
    for (int step = 0; step < static_cast<int>(std::size(kSteps)); ++step)
      text += format(" %14s", cell(count(tally, obj_id, range, step)).c_str());
  }
  return text + "\n";
}

std::string false_ones(const Tally& tally) {
  std::string text = "False detections at a confidence of 0.5: ";
  for (std::size_t i = 0; i < tally.ranges.size(); ++i)
    text += (i == 0 ? "" : ", ") +
            format("%d in %d scans at %g m", tally.wrong[i], tally.scans[i], tally.ranges[i]);
  return text + ".\n";
}

std::string threshold_text(const Tally& tally, double precision) {
  const auto threshold = threshold_for(tally.verdicts, precision);
  if (tally.verdicts.empty()) return "Nothing was detected, so there is no threshold to give.\n";
  if (!threshold)
    return format("No confidence separates: at none are %g of the detections from it up right.\n",
                  precision);
  int kept = 0, right = 0;
  for (const Verdict& one : tally.verdicts)
    if (one.score >= *threshold) ++kept, right += one.correct ? 1 : 0;
  std::string text =
      static_cast<std::size_t>(kept) == tally.verdicts.size()
          ? format("Believe every detection (confidence from 0.50): %d of %d are right.", right,
                   kept)
          : format("Believe a confidence of %.2f or more: of such detections %d of %d are right.",
                   *threshold, right, kept);
  constexpr double kRuleOfThree = 3;  // none in n: at most 3 / n with a probability of 95 %
  if (const double shown = 1 - kRuleOfThree / kept; right == kept && shown < precision)
    text += format(" So few show a precision of %.2f at most: more --scans say more.",
                   std::max(0.0, shown));
  return text + "\n";
}

std::string sentence(const Tally& tally, int obj_id) {
  const std::string& name = tally.parts[static_cast<std::size_t>(obj_id) - 1];
  if (const auto reach = reach_of(tally, obj_id))
    return name +
           format(
               ": found in %.0f %% (%d of %d) when not farther than %g m and at least %.0f %% "
               "visible.\n",
               100.0 * reach->found / reach->instances, reach->found, reach->instances,
               reach->range, 100 * reach->visible);
  Count best;
  for (const double range : tally.ranges)
    if (const Count here = count(tally, obj_id, range, 0); here.recall() >= best.recall())
      best = here;
  return name + format(": not found reliably: even in full view at the best range only %d of %d.\n",
                       best.found, best.instances);
}

nlohmann::ordered_json rows(const Tally& tally) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t part = 0; part < tally.parts.size(); ++part)
    for (const double range : tally.ranges)
      for (int step = -1; step < static_cast<int>(std::size(kSteps)); ++step) {
        const Count here = count(tally, static_cast<int>(part) + 1, range, step);
        rows.push_back({{"part", mend_utf8(tally.parts[part])},
                        {"range_m", range},
                        {"visible", step < 0 ? "all" : step_name(step)},
                        {"instances", here.instances},
                        {"found", here.found},
                        {"recall", here.recall()}});
      }
  return rows;
}

/// Recall over what is visible, a line for each range; and precision over the confidence.
std::string charts(const Tally& tally) {
  plot::Chart recall, precision;
  recall.title = "recall", recall.x_label = "visible [%]", recall.y_label = "recall";
  recall.x_range = {0.0, 100.0}, recall.y_range = {0.0, 1.0};
  for (const double range : tally.ranges) {
    plot::Series series{format("%g m", range), {}, {}};
    for (int step = static_cast<int>(std::size(kSteps)) - 1; step >= 0; --step) {
      const Count here = count(tally, 0, range, step);
      if (here.instances == 0) continue;
      const auto i = static_cast<std::size_t>(step);
      series.x.push_back(50 * (kSteps[i] + (i == 0 ? 1 : kSteps[i - 1])));
      series.y.push_back(here.recall());
    }
    recall.series.push_back(std::move(series));
  }
  precision.title = "precision of what is believed", precision.x_label = "confidence from";
  precision.y_label = "precision", precision.y_range = {0.0, 1.0}, precision.x_range = {0.5, 1.0};
  plot::Series series{"all ranges", {}, {}};
  for (const CurvePoint& point : make_curve(tally.verdicts, 1)) {
    series.x.push_back(point.score), series.y.push_back(point.counts.precision());
  }
  precision.series.push_back(std::move(series));
  return plot::to_svg({recall, precision});
}

}  // namespace

std::optional<double> threshold_for(const std::vector<Verdict>& verdicts, double precision) {
  std::optional<double> threshold;
  for (const CurvePoint& point : make_curve(verdicts, 1))
    if (point.counts.precision() >= precision) threshold = point.score;
  return threshold;
}

std::optional<Reach> reach_of(const Tally& tally, int obj_id) {
  std::optional<Reach> best;
  for (const double range : tally.ranges)
    for (std::size_t step = 0; step < std::size(kSteps); ++step) {
      Count all, farthest, most_hidden;
      for (const Outcome& one : tally.outcomes) {
        if (one.obj_id != obj_id || one.range > range || one.visible < kSteps[step]) continue;
        all.add(one);
        if (one.range == range) farthest.add(one);
        if (step_of(one.visible) == static_cast<int>(step)) most_hidden.add(one);
      }
      // The many at its middle must not speak for the few at its edges.
      const bool holds = all.instances >= kFewest && all.recall() >= kWanted &&
                         farthest.recall() >= kWanted && most_hidden.recall() >= kWanted;
      if (holds && (!best || all.instances > best->instances))
        best = Reach{range, kSteps[step], all.found, all.instances};
    }
  return best;
}

std::string to_text(const Tally& tally, const Command& command) {
  std::string text;
  for (std::size_t part = 1; part <= tally.parts.size(); ++part)
    text += "\n" + tally.parts[part - 1] + ", recall over what is visible of it\n" +
            table(tally, static_cast<int>(part));
  text += "\n" + false_ones(tally) + threshold_text(tally, command.precision) + "\n";
  for (std::size_t part = 1; part <= tally.parts.size(); ++part)
    text += sentence(tally, static_cast<int>(part));
  return text;
}

void write(const Tally& tally, const Command& command) {
  const auto threshold = threshold_for(tally.verdicts, command.precision);
  nlohmann::ordered_json json{{"sensor", mend_utf8(command.sensor)},
                              {"precision_wanted", command.precision},
                              {"rows", rows(tally)},
                              {"ranges", nlohmann::json::array()}};
  json["threshold"] = threshold ? nlohmann::ordered_json(*threshold) : nlohmann::ordered_json();
  for (std::size_t i = 0; i < tally.ranges.size(); ++i)
    json["ranges"].push_back({{"range_m", tally.ranges[i]},
                              {"scans", tally.scans[i]},
                              {"false_detections", tally.wrong[i]}});
  std::string summary;
  for (std::size_t part = 1; part <= tally.parts.size(); ++part)
    summary += sentence(tally, static_cast<int>(part));
  json["summary"] = mend_utf8(summary);
  write_report(std::filesystem::path(command.out) / "recall", json.dump(1) + "\n",
               to_csv(json["rows"]), charts(tally));
}

}  // namespace posevote::part
