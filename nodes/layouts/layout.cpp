// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/layout.hpp"

#include <map>
#include <stdexcept>

#include "nodes/layouts/files.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;

std::map<std::string, Layout>& registry() {
  static std::map<std::string, Layout> layouts;  // filled before main by the layouts' own files
  return layouts;
}

}  // namespace

bool register_layout(const Layout& layout) {
  if (!registry().emplace(layout.name, layout).second)
    throw std::logic_error("two layouts are registered as '" + layout.name + "'");
  return true;
}

const Layout& find_layout(const fs::path& dataset, const std::string& split) {
  if (!fs::is_directory(dataset)) fail(dataset, "no such folder");
  std::string known;
  for (const auto& [name, layout] : registry()) {
    if (layout.recognises(dataset, split)) return layout;
    known += "\n  " + name + ": " + layout.expected;
  }
  fail(dataset, "is no data set with a split '" + split + "'; expected one of" + known);
}

}  // namespace posevote::layouts
