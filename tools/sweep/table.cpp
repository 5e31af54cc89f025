// SPDX-License-Identifier: BSD-3-Clause
// What a sweep says: as text, rows, JSON and a plot.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "graph/schema.hpp"
#include "tools/plot/line_chart.hpp"
#include "tools/sweep/sweep.hpp"
#include "tools/text.hpp"

namespace posevote::sweep {
namespace {

using Json = nlohmann::ordered_json;

std::string to_text(double value, const Interval& interval) {
  const std::string range = std::isnan(interval.low)
                                ? "[    -,     -]"
                                : format("[%.3f, %.3f]", interval.low, interval.high);
  return format("%.3f %s", value, range.c_str());
}

double per_image(const Sweep& sweep, double value) {
  return sweep.images > 0 ? value / static_cast<double>(sweep.images) : 0;
}

/// Not told from the best: the interval of their difference holds zero.
bool as_good(const Judged& rule, std::size_t setting) {
  return setting == rule.best || rule.certainty[setting].behind.low <= 0;
}

std::string standing(const Judged& rule, std::size_t setting) {
  if (setting == rule.best) return "best";
  const Interval& behind = rule.certainty[setting].behind;
  if (std::isnan(behind.low)) return "";
  return (as_good(rule, setting) ? "not told from it: " : "worse: ") +
         format("%.3f to %.3f below", behind.low, behind.high);
}

std::string line(const Sweep& sweep, const Judged& rule, std::size_t i) {
  const Setting& setting = sweep.settings[i];
  const Counts& counts = rule.counts[i];
  const Certainty& certainty = rule.certainty[i];
  const std::string f1 = rule.rule.average() ? "" : to_text(counts.f1(), certainty.f1);
  return format("%4zu  %-20s  %-20s  %8.3f  %6zu  ", i + 1,
                to_text(counts.recall(), certainty.recall).c_str(), f1.c_str(),
                per_image(sweep, setting.seconds), setting.failed) +
         standing(rule, i) + "\n      " + to_text(sweep.axes, setting.values) + "\n";
}

std::string best_line(const Sweep& sweep, const Judged& rule) {
  const Counts& counts = rule.counts[rule.best];
  const Certainty& certainty = rule.certainty[rule.best];
  std::size_t others = 0;
  for (std::size_t i = 0; i < rule.counts.size(); ++i) others += as_good(rule, i) ? 1 : 0;
  const std::string figure = rule.rule.average()
                                 ? "recall " + to_text(counts.recall(), certainty.recall)
                                 : "F1 " + to_text(counts.f1(), certainty.f1);
  std::string text = "best by " + rule.rule.text + ": " +
                     to_text(sweep.axes, sweep.settings[rule.best].values) + "; " + figure;
  if (sweep.images < 2) return text + "\n      fewer than two scans have no interval\n";
  return text +
         format(
             "\n      95 %%, bootstrap over %zu scans; others that cannot be told from it: %zu\n",
             sweep.images, others - 1);
}

Json best_json(const Sweep& sweep, const Judged& rule) {
  Json json{{"rule", rule.rule.name}, {"setting", rule.best + 1}, {"values", Json::object()}};
  for (std::size_t a = 0; a < sweep.axes.size(); ++a)
    json["values"][sweep.axes[a].name()] = sweep.settings[rule.best].values[a];
  const bool average = rule.rule.average();
  const Certainty& certainty = rule.certainty[rule.best];
  const Interval& interval = average ? certainty.recall : certainty.f1;
  json["figure"] = average ? "recall" : "f1";
  json["value"] = (rule.counts[rule.best].*figure_of(rule.rule))();
  json["low"] = interval.low;
  json["high"] = interval.high;
  json["not_told_from_it"] = Json::array();
  for (std::size_t i = 0; i < rule.counts.size(); ++i)
    if (i != rule.best && as_good(rule, i)) json["not_told_from_it"].push_back(i + 1);
  return json;
}

Json row_of(const Sweep& sweep, const Judged& rule, std::size_t i) {
  const Counts& counts = rule.counts[i];
  const Certainty& certainty = rule.certainty[i];
  Json row{{"rule", rule.rule.name}, {"setting", i + 1}};
  for (std::size_t a = 0; a < sweep.axes.size(); ++a)
    row[sweep.axes[a].name()] = sweep.settings[i].values[a];
  row["instances"] = counts.instances;
  row["correct"] = counts.correct;
  const auto if_judged = [&](const char* name, double value) {
    row[name] = rule.applies() ? Json(value) : Json(nullptr);
  };
  if_judged("recall", counts.recall());
  if_judged("recall_low", certainty.recall.low);
  if_judged("recall_high", certainty.recall.high);
  const auto unless_average = [&](const char* name, const Json& value) {
    row[name] = rule.rule.average() ? Json(nullptr) : value;
  };
  unless_average("detections", counts.detections);
  unless_average("precision", counts.precision());
  unless_average("f1", counts.f1());
  unless_average("f1_low", certainty.f1.low);
  unless_average("f1_high", certainty.f1.high);
  row["behind_low"] = certainty.behind.low;
  row["behind_high"] = certainty.behind.high;
  row["failed"] = sweep.settings[i].failed;
  row["seconds_per_scan"] = per_image(sweep, sweep.settings[i].seconds);
  return row;
}

/// Where a value of the first axis stands in the plot: itself, or its place where one is no number.
std::vector<double> places_of(const Axis& axis) {
  std::vector<double> numbers, places;
  for (const std::string& value : axis.values) {
    if (const auto number = graph::Scalar<double>::parse(value)) numbers.push_back(*number);
    places.push_back(static_cast<double>(places.size() + 1));
  }
  return numbers.size() == places.size() ? numbers : places;
}

/// A line for each combination of the other axes' values.
plot::Chart chart(const Sweep& sweep, const std::string& title, const std::string& label,
                  const std::function<double(std::size_t setting)>& value) {
  const Axis& axis = sweep.axes.front();
  const std::vector<double> places = places_of(axis);
  const std::vector<Axis> others(sweep.axes.begin() + 1, sweep.axes.end());
  const std::size_t lines = sweep.settings.size() / places.size();
  plot::Chart chart;
  chart.title = title;
  chart.x_label = axis.name();
  chart.y_label = label;
  for (std::size_t i = 0; i < lines; ++i) {
    const Values& values = sweep.settings[i].values;
    plot::Series series{to_text(others, {values.begin() + 1, values.end()}), {}, {}};
    for (std::size_t x = 0; x < places.size(); ++x) {
      series.x.push_back(places[x]);
      series.y.push_back(value(x * lines + i));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::string to_text(const Sweep& sweep) {
  std::string text;
  SharedStages::Calls all;
  for (const auto& [node, calls] : sweep.calls) {
    all.asked += calls.asked;
    all.made += calls.made;
  }
  text += format("settings: %zu, scans: %zu; %zu of %zu calls of nodes made, the others shared\n",
                 sweep.settings.size(), sweep.images, all.made, all.asked);
  for (const Judged& rule : sweep.rules) {
    text += "\n" + rule.rule.text + "\n";
    if (!rule.applies()) {
      text += "no instance can be judged by it here; `posevote evaluate` says why\n";
      continue;
    }
    text += format("%4s  %-20s  %-20s  %8s  %6s\n", "", "recall [95 %]",
                   rule.rule.average() ? "" : "F1 [95 %]", "s a scan", "failed");
    for (std::size_t i = 0; i < sweep.settings.size(); ++i) text += line(sweep, rule, i);
    text += best_line(sweep, rule);
  }
  return text;
}

Json rows_of(const Sweep& sweep) {
  Json rows = Json::array();
  for (const Judged& rule : sweep.rules)
    for (std::size_t i = 0; i < sweep.settings.size(); ++i) rows.push_back(row_of(sweep, rule, i));
  return rows;
}

Json to_json(const Sweep& sweep) {
  Json json{{"scans", sweep.images}, {"rows", rows_of(sweep)}, {"best", Json::array()}};
  for (const Judged& rule : sweep.rules)
    if (rule.applies()) json["best"].push_back(best_json(sweep, rule));
  for (const auto& [node, calls] : sweep.calls)
    json["calls"][node] = {{"asked", calls.asked}, {"made", calls.made}};
  return json;
}

std::string to_svg(const Sweep& sweep) {
  const auto shown = std::find_if(sweep.rules.begin(), sweep.rules.end(),
                                  [](const Judged& rule) { return rule.applies(); });
  const Judged& rule = shown == sweep.rules.end() ? sweep.rules.front() : *shown;
  std::vector<plot::Chart> charts;
  const auto add = [&](const std::string& title, const std::string& label, const auto& value) {
    charts.push_back(chart(sweep, title, label, value));
  };
  add(rule.rule.text, "recall", [&](std::size_t i) { return rule.counts[i].recall(); });
  if (!rule.rule.average())
    add(rule.rule.text, "F1", [&](std::size_t i) { return rule.counts[i].f1(); });
  for (plot::Chart& each : charts) each.y_range = {0, 1};
  const auto seconds = [&](std::size_t i) { return per_image(sweep, sweep.settings[i].seconds); };
  add("one scan at a time", "s a scan", seconds);
  double most = 0;
  for (std::size_t i = 0; i < sweep.settings.size(); ++i) most = std::max(most, seconds(i));
  charts.back().y_range = {0, 1.2 * most};  // with room for the legend
  return plot::to_svg(charts);
}

}  // namespace posevote::sweep
