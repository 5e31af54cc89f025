// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/grid.hpp"

#include <algorithm>
#include <stdexcept>

#include "graph/problem.hpp"
#include "graph/yaml_reader.hpp"

namespace posevote::sweep {
namespace {

constexpr std::size_t kMostSettings = 1000;

[[noreturn]] void refuse(const std::string& argument, const std::string& what) {
  throw std::invalid_argument("--vary " + argument + ": " + what);
}

/// The parts between commas that stand in no brackets.
std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values{""};
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

Axis read_axis(const std::string& argument) {
  std::vector<graph::Problem> problems;
  const graph::Override change = graph::read_set(argument, problems);
  if (!problems.empty()) refuse(argument, "expected NODE.PARAM=VALUE,VALUE...");
  Axis axis{change.node, change.key, split_values(change.setting.text)};
  for (const std::string& value : axis.values)
    if (value.empty()) refuse(argument, "a value is missing, expected NODE.PARAM=VALUE,VALUE...");
  return axis;
}

}  // namespace

std::vector<Axis> read_axes(const std::vector<std::string>& arguments) {
  std::vector<Axis> axes;
  for (const std::string& argument : arguments) {
    Axis axis = read_axis(argument);
    const bool again = std::any_of(axes.begin(), axes.end(),
                                   [&](const Axis& other) { return other.name() == axis.name(); });
    if (again)
      refuse(argument, axis.name() + " is varied twice, expected all values in one --vary");
    axes.push_back(std::move(axis));
  }
  return axes;
}

std::vector<Values> combine(const std::vector<Axis>& axes) {
  std::vector<Values> all{{}};
  for (const Axis& axis : axes) {
    std::vector<Values> longer;
    if (all.size() * axis.values.size() > kMostSettings)
      throw std::invalid_argument("--vary: more than " + std::to_string(kMostSettings) +
                                  " settings in all; expected fewer values");
    for (const Values& values : all)
      for (const std::string& value : axis.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

std::vector<graph::Override> overrides_of(const std::vector<Axis>& axes, const Values& values) {
  std::vector<graph::Override> overrides;
  for (std::size_t i = 0; i < axes.size(); ++i)
    overrides.push_back({axes[i].node,
                         axes[i].param,
                         {values[i], {"--vary " + axes[i].name() + "=" + values[i], 0, 0}}});
  return overrides;
}

std::string to_text(const std::vector<Axis>& axes, const Values& values) {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i)
    text += (i > 0 ? ", " : "") + axes[i].name() + "=" + values[i];
  return text;
}

}  // namespace posevote::sweep
