// SPDX-License-Identifier: BSD-3-Clause
#include "graph/registry.hpp"

#include <cxxabi.h>

#include <cstdlib>
#include <list>
#include <map>
#include <mutex>
#include <stdexcept>

#include "graph/plugin.hpp"

namespace posevote::graph {
namespace {

struct Registry {
  std::recursive_mutex mutex;  ///< a library registers its nodes while it is being loaded
  std::map<std::string, NodeSpec> nodes;
  bool loads = false;
  std::list<NodeSpec> taken;  ///< of the library that is being loaded: names that others have
};

/// Filled before main by the nodes' own files, and later by plugins.
Registry& registry() {
  static Registry all;
  return all;
}

const NodeSpec* find_loaded(const std::string& name) {
  const std::lock_guard lock(registry().mutex);
  const auto found = registry().nodes.find(name);
  return found == registry().nodes.end() ? nullptr : &found->second;
}

}  // namespace

namespace detail {

std::vector<std::string> names_taken(const std::function<void()>& load) {
  const std::lock_guard lock(registry().mutex);
  registry().loads = true;
  registry().taken.clear();
  load();
  registry().loads = false;
  std::vector<std::string> names;
  for (const NodeSpec& spec : registry().taken) names.push_back(spec.name);
  return names;
}

std::size_t count_nodes() {
  const std::lock_guard lock(registry().mutex);
  return registry().nodes.size();
}

}  // namespace detail

const NodeSpec* find_node(const std::string& name) {
  if (const NodeSpec* known = find_loaded(name)) return known;
  detail::load_bundled();
  return find_loaded(name);
}

std::vector<const NodeSpec*> all_nodes() {
  detail::load_bundled();
  const std::lock_guard lock(registry().mutex);
  std::vector<const NodeSpec*> nodes;
  for (const auto& [name, spec] : registry().nodes) nodes.push_back(&spec);
  return nodes;
}

NodeSpec& add_node(NodeSpec spec) {
  const std::lock_guard lock(registry().mutex);
  const std::string name = spec.name;
  const auto place = registry().nodes.find(name);
  if (place == registry().nodes.end())
    return registry().nodes.emplace(name, std::move(spec)).first->second;
  if (!registry().loads) throw std::logic_error("two nodes are registered as '" + name + "'");
  return registry().taken.emplace_back(std::move(spec));  // nothing can be thrown through a loader
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
