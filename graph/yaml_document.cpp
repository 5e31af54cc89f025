// SPDX-License-Identifier: BSD-3-Clause
#include "graph/yaml_document.hpp"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <vector>

namespace posevote::graph::detail {
namespace {

/// "node.param"; the key alone where there is no node.
std::string dotted(const std::string& subject, const std::string& key) {
  return subject.empty() ? key : subject + "." + key;
}

/// Where documents start, and nothing else of them.
class Starts : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;

  void OnDocumentStart(const YAML::Mark& mark) override { marks.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// Where the file's second document starts, if it has one. Not by YAML::LoadAll, which finds
/// documents without end, and takes memory for each, where one begins with a comma (yaml-cpp 0.7).
std::optional<YAML::Mark> second_document(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  YAML::Parser parser(stream);
  Starts starts;
  if (!parser.HandleNextDocument(starts) || !parser.HandleNextDocument(starts)) return std::nullopt;
  return starts.marks.size() > 1 ? std::optional(starts.marks[1]) : std::nullopt;
}

}  // namespace

YAML::Node Reader::load() const {
  try {
    if (std::filesystem::is_directory(file)) {  // yaml-cpp would leak what it began to read
      report({file, 0, 0}, "", "is a folder, expected a YAML file");
      return YAML::Node(YAML::NodeType::Undefined);
    }
    YAML::Node document = YAML::LoadFile(file);
    if (document.IsMap()) {
      if (const auto second = second_document(file))
        report(at(*second), "", "starts another YAML document; only the first would count");
      return document;
    }
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
