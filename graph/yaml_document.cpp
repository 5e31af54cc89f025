// SPDX-License-Identifier: BSD-3-Clause
#include "graph/yaml_document.hpp"

#include <yaml-cpp/depthguard.h>

#include <filesystem>
#include <map>

namespace posevote::graph::detail {
namespace {

/// "node.param"; the key alone where there is no node.
std::string dotted(const std::string& subject, const std::string& key) {
  return subject.empty() ? key : subject + "." + key;
}

}  // namespace

YAML::Node Reader::load() const {
  try {
    if (std::filesystem::is_directory(file)) {  // yaml-cpp would leak what it began to read
      report({file, 0, 0}, "", "is a folder, expected a YAML file");
      return YAML::Node(YAML::NodeType::Undefined);
    }
    const std::vector<YAML::Node> documents = YAML::LoadAllFromFile(file);
    for (std::size_t i = 1; i < documents.size(); ++i)
      report(at(documents[i]), "", "starts another YAML document; only the first would count");
    if (!documents.empty() && documents[0].IsMap()) return documents[0];
    report({file, 1, 1}, "", "expected a map of keys, as in `pipeline: recognize`");
  } catch (const YAML::BadFile&) {
    report({file, 0, 0}, "", "cannot be read: no such file?");
  } catch (const YAML::Exception& error) {
    report(at(error.mark), "", "is not valid YAML: " + reason_of(error));
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

void Reader::for_each(const YAML::Node& map, const std::string& subject, const Visit& visit) const {
  std::map<std::string, Location> seen;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) {
      report(at(entry.first), subject, "a key must be a plain word");
      continue;
    }
    const std::string key = entry.first.Scalar();
    const auto [first, is_new] = seen.emplace(key, at(entry.first));
    if (is_new)
      visit(key, first->second, entry.second);
    else
      report(at(entry.first), dotted(subject, key),
             "given twice, first in line " + std::to_string(first->second.line));
  }
}

std::string Reader::scalar(const YAML::Node& node, const Location& key,
                           const std::string& subject) const {
  if (node.IsScalar()) return node.Scalar();
  report(node.IsNull() ? key : at(node), subject, "expected one plain value");
  return "";
}

Setting Reader::setting(const YAML::Node& node, const Location& key,
                        const std::string& subject) const {
  if (!node.IsSequence())
    return {scalar(node, key, subject), node.IsScalar() ? at(node) : key, false};
  std::vector<std::string> items;
  for (const auto& item : node) {
    items.push_back(scalar(item, key, subject));
    if (items.back().find(',') != std::string::npos)
      report(at(item), subject, "'" + items.back() + "': an item of a list holds no comma");
  }
  return {join_list(items), at(node), true};
}

std::vector<Wire> Reader::wires(const YAML::Node& node, const Location& key,
                                const std::string& subject) const {
  std::vector<Wire> found;
  if (node.IsMap()) {
    for_each(node, subject,
             [&](const std::string& port, const Location& where, const YAML::Node& value) {
               const std::string stream = scalar(value, where, subject + "." + port);
               if (!stream.empty()) found.push_back({port, stream, at(value)});
             });
  } else if (node.IsSequence()) {
    for (const auto& item : node) {
      const std::string stream = scalar(item, key, subject);
      if (!stream.empty()) found.push_back({"", stream, at(item)});
    }
  } else if (const std::string stream = scalar(node, key, subject); !stream.empty()) {
    found.push_back({"", stream, at(node)});
  }
  return found;
}

std::string reason_of(const YAML::Exception& error) {
  const bool is_deep = dynamic_cast<const YAML::DeepRecursion*>(&error) != nullptr;
  return is_deep ? "nested deeper than 500" : error.msg;  // its own text is "bad file"
}

}  // namespace posevote::graph::detail
