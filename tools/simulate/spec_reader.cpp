// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/spec_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

namespace posevote {

using graph::ParamSpec;

YAML::Node SpecReader::load() {
  try {
    if (!std::filesystem::is_directory(file)) return YAML::LoadFile(file);
    report({file, 0, 0}, "", "is a folder, expected a YAML file");
  } catch (const YAML::BadFile&) {
    report({file, 0, 0}, "", "cannot be read: no such file?");
  } catch (const YAML::Exception& error) {
    report(at(error.mark), "", "is not valid YAML: " + error.msg);
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

void SpecReader::read_value(const YAML::Node& value, const std::string& subject,
                            const ParamSpec& param, void* target) {
  if (!value.IsScalar()) return report(value, subject, "expected one plain value");
  if (const auto problem = param.set(target, value.Scalar()))
    report(value, subject, "is '" + value.Scalar() + "', " + *problem);
}

void SpecReader::read_map(const YAML::Node& map, const std::string& subject,
                          const std::vector<ParamSpec>& params, void* target,
                          const std::vector<std::string>& lists) {
  if (!map.IsMap()) return report(map, subject, "expected {key: value ...}");
  std::vector<std::string> known = lists;
  for (const ParamSpec& param : params) known.push_back(param.name);
  std::map<std::string, int> line_of;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const std::string name = subject.empty() ? key : std::string(subject).append(".").append(key);
    const auto [first, is_new] = line_of.emplace(key, entry.first.Mark().line + 1);
    const auto param = std::find_if(params.begin(), params.end(),
                                    [&](const ParamSpec& other) { return other.name == key; });
    if (!is_new) {
      report(entry.first, name, "given twice, first in line " + std::to_string(first->second));
    } else if (param != params.end()) {
      read_value(entry.second, name, *param, target);
    } else if (std::find(lists.begin(), lists.end(), key) == lists.end()) {
      const std::string near = graph::closest_name(key, known);
      report(entry.first, name,
             "unknown key" + (near.empty() ? "" : ", did you mean '" + near + "'?"));
    }
  }
}

std::vector<YAML::Node> SpecReader::list(const YAML::Node& map, const std::string& subject,
                                         const std::string& key) {
  const std::string name = subject.empty() ? key : subject + "." + key;
  const YAML::Node node = map.IsMap() ? map[key] : YAML::Node(YAML::NodeType::Undefined);
  if (!node.IsDefined()) {
    if (map.IsMap()) report(map, name, "missing, expected a list");
    return {};
  }
  if (!node.IsSequence() || node.size() == 0) {
    report(node.IsNull() ? map : node, name, "expected a list of at least one");
    return {};
  }
  return {node.begin(), node.end()};
}

}  // namespace posevote
