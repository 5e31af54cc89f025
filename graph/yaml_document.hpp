// SPDX-License-Identifier: BSD-3-Clause
// One YAML file with its name for messages, for graph/yaml_reader.hpp alone.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "graph/description.hpp"
#include "graph/schema.hpp"

namespace posevote::graph::detail {

/// Reads values of a file; what is wrong with them goes to `problems`.
struct Reader {
  using Visit = std::function<void(const std::string&, const Location&, const YAML::Node&)>;

  std::string file;
  std::vector<Problem>* problems;

  Location at(const YAML::Mark& mark) const { return {file, mark.line + 1, mark.column + 1}; }
  Location at(const YAML::Node& node) const { return at(node.Mark()); }
  void report(const Location& where, std::string subject, std::string text) const {
    problems->push_back({where, std::move(subject), std::move(text)});
  }

  /// The file's map; undefined where there is none.
  YAML::Node load() const;
  /// Calls visit(key, key's place, value) for each entry; reports keys given twice (yaml-cpp itself
  /// would silently take the first) and keys that are no plain words.
  void for_each(const YAML::Node& map, const std::string& subject, const Visit& visit) const;
  /// One plain value; `key`: where its key stands.
  std::string scalar(const YAML::Node& node, const Location& key, const std::string& subject) const;
  /// A parameter's value: a plain one, or a list of them.
  Setting setting(const YAML::Node& node, const Location& key, const std::string& subject) const;
  /// `a`, `[a, b]` or `{port: a}`.
  std::vector<Wire> wires(const YAML::Node& node, const Location& key,
                          const std::string& subject) const;
};

/// What an exception of yaml-cpp says, without the place.
std::string reason_of(const YAML::Exception& error);

}  // namespace posevote::graph::detail
