// SPDX-License-Identifier: BSD-3-Clause
#include "graph/registry.hpp"

#include <cxxabi.h>

#include <cstdlib>
#include <map>
#include <stdexcept>

namespace posevote::graph {
namespace {

std::map<std::string, NodeSpec>& registry() {
  static std::map<std::string, NodeSpec> nodes;  // filled before main by the nodes' own files
  return nodes;
}

}  // namespace

const NodeSpec* find_node(const std::string& name) {
  const auto found = registry().find(name);
  return found == registry().end() ? nullptr : &found->second;
}

std::vector<const NodeSpec*> all_nodes() {
  std::vector<const NodeSpec*> nodes;
  for (const auto& [name, spec] : registry()) nodes.push_back(&spec);
  return nodes;
}

NodeSpec& add_node(NodeSpec spec) {
  const std::string name = spec.name;
  const auto [place, added] = registry().emplace(name, std::move(spec));
  if (!added) throw std::logic_error("two nodes are registered as '" + name + "'");
  return place->second;
}

std::string type_name(const std::type_info& type) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), std::free);
  std::string name = text ? text.get() : type.name();
  for (std::size_t at = 0; (at = name.find("posevote::", at)) != std::string::npos;)
    name.erase(at, std::string("posevote::").size());
  // "std::vector<X, std::allocator<X> >" is what a user reads as "vector<X>".
  if (const std::size_t allocator = name.find(", std::allocator"); allocator != std::string::npos)
    name = name.substr(name.starts_with("std::") ? 5 : 0, allocator - 5) + ">";
  return name;
}

}  // namespace posevote::graph
