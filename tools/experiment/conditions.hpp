// SPDX-License-Identifier: BSD-3-Clause
// A replica's images by what its spec varies: how far the sensor stood and how noisy it was.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/evaluate/evaluate.hpp"

namespace posevote {

/// Images taken alike.
struct Conditions {
  double distance = 0;  ///< from the sensor to the middle of the scene [m]
  double noise = 0;     ///< deviation of ranges [m]
  auto operator<=>(const Conditions&) const = default;
};

/// What was found under each of them, by one rule.
using CountsByConditions = std::map<Conditions, Counts>;

/// Splits an evaluation of a replica that was made from `spec`, every `step`th image of it. Images
/// whose noise is the sensor's own are left out. Throws graph::ConfigError for a bad spec.
CountsByConditions split_by_conditions(const layouts::GroundTruth& truth,
                                       const std::vector<FoundInstance>& found,
                                       const EvaluateOptions& options, const std::string& spec,
                                       std::size_t step);

/// What a method found.
struct MethodCounts {
  std::string method;
  CountsByConditions counts;
};

/// A row for each method and condition.
nlohmann::ordered_json to_json(const std::vector<MethodCounts>& methods);

/// Tables in Markdown: for each method recall and precision, a row for each distance and a column
/// for each noise.
std::string to_markdown(const std::vector<MethodCounts>& methods);

/// Recall over noise, a line for each distance; a chart for each method; SVG.
std::string conditions_svg(const std::vector<MethodCounts>& methods);

}  // namespace posevote
