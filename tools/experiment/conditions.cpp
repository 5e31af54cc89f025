// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/conditions.hpp"

#include <set>

#include "tools/plot/line_chart.hpp"
#include "tools/simulate/spec.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

/// The images of each kind, numbered as the simulation numbers them.
std::map<Conditions, std::set<int>> images_by_conditions(const Spec& spec, std::size_t step) {
  std::map<Conditions, std::set<int>> images;
  for (std::size_t i = 0; i < spec.scenes.size(); i += step)
    if (const SceneSpec& scene = spec.scenes[i]; scene.noise != kSensorsOwn)
      images[{scene.distance, scene.noise}].insert(static_cast<int>(i / step));
  return images;
}

/// A line of a Markdown table: one cell for each noise, "-" where there is none.
std::string line(const CountsByConditions& counts, double distance, const std::set<double>& noises,
                 double (Counts::*value)() const) {
  std::string text = format("| %g m |", distance);
  for (const double noise : noises) {
    const auto found = counts.find({distance, noise});
    text += found == counts.end() ? " - |" : format(" %.3f |", (found->second.*value)());
  }
  return text + "\n";
}

std::string table(const MethodCounts& method, const char* what, double (Counts::*value)() const) {
  std::set<double> distances, noises;
  for (const auto& [conditions, counts] : method.counts)
    distances.insert(conditions.distance), noises.insert(conditions.noise);
  std::string head = "| " + method.method + ", " + what + " at noise of |", rule = "|---|";
  for (const double noise : noises) head += format(" %g mm |", 1000 * noise), rule += "---|";
  std::string text = head + "\n" + rule + "\n";
  for (const double distance : distances) text += line(method.counts, distance, noises, value);
  return text + "\n";
}

}  // namespace

CountsByConditions split_by_conditions(const layouts::GroundTruth& truth,
                                       const std::vector<FoundInstance>& found,
                                       const EvaluateOptions& options, const std::string& spec,
                                       std::size_t step) {
  CountsByConditions counts;
  for (const auto& [conditions, images] : images_by_conditions(read_spec(spec), step)) {
    const auto is_of_others = [&kept = images](const auto& one) {
      return !kept.contains(one.im_id);
    };
    layouts::GroundTruth part = truth;
    std::erase_if(part.instances, is_of_others);
    std::vector<FoundInstance> rows = found;
    std::erase_if(rows, is_of_others);
    if (part.instances.empty()) continue;
    counts[conditions] = evaluate(part, rows, options).all[0].counts;
  }
  return counts;
}

nlohmann::ordered_json to_json(const std::vector<MethodCounts>& methods) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const MethodCounts& method : methods)
    for (const auto& [conditions, counts] : method.counts)
      rows.push_back({{"method", method.method},
                      {"distance_m", conditions.distance},
                      {"noise_mm", 1000 * conditions.noise},
                      {"instances", counts.instances},
                      {"detections", counts.detections},
                      {"correct", counts.correct},
                      {"recall", counts.recall()},
                      {"precision", counts.precision()}});
  return rows;
}

std::string to_markdown(const std::vector<MethodCounts>& methods) {
  std::string text;
  for (const MethodCounts& method : methods)
    text +=
        table(method, "recall", &Counts::recall) + table(method, "precision", &Counts::precision);
  return text;
}

std::string conditions_svg(const std::vector<MethodCounts>& methods) {
  std::vector<plot::Chart> charts;
  for (const MethodCounts& method : methods) {
    plot::Chart& chart = charts.emplace_back();
    chart.title = method.method, chart.x_label = "noise [mm]", chart.y_label = "recall";
    chart.y_range = {0.0, 1.0}, chart.log_x = true;
    std::map<double, plot::Series> lines;
    for (const auto& [conditions, counts] : method.counts) {
      plot::Series& series = lines[conditions.distance];
      series.name = format("%g m", conditions.distance);
      series.x.push_back(1000 * conditions.noise), series.y.push_back(counts.recall());
    }
    for (auto& [distance, series] : lines) chart.series.push_back(std::move(series));
  }
  return plot::to_svg(charts);
}

}  // namespace posevote
