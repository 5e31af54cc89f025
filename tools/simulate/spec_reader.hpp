// SPDX-License-Identifier: BSD-3-Clause
// Reads YAML that describes what to simulate: maps of plain values, lists of maps.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "graph/problem.hpp"
#include "graph/schema.hpp"

namespace posevote {

/// Reads one file; what is wrong goes to `problems`.
struct SpecReader {
  std::string file;
  std::vector<graph::Problem> problems;

  graph::Location at(const YAML::Mark& mark) const {
    return {file, mark.line + 1, mark.column + 1};
  }
  void report(const graph::Location& where, const std::string& subject, const std::string& text) {
    problems.push_back({where, subject, text});
  }
  void report(const YAML::Node& node, const std::string& subject, const std::string& text) {
    report(at(node.Mark()), subject, text);
  }

  /// The file's root; undefined where it cannot be read.
  YAML::Node load();
  /// Reads a map: plain values by `params` into `target`, `lists` are left to the caller.
  void read_map(const YAML::Node& map, const std::string& subject,
                const std::vector<graph::ParamSpec>& params, void* target,
                const std::vector<std::string>& lists);
  void read_value(const YAML::Node& value, const std::string& subject,
                  const graph::ParamSpec& param, void* target);
  /// The entries of a list; an empty or missing one is a problem.
  std::vector<YAML::Node> list(const YAML::Node& map, const std::string& subject,
                               const std::string& key);
};

}  // namespace posevote
