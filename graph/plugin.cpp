// SPDX-License-Identifier: BSD-3-Clause
#include "graph/plugin.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "graph/did_you_mean.hpp"
#include "graph/registry.hpp"

#ifdef POSEVOTE_ABI
extern "C" {
extern const char POSEVOTE_ABI;
const char POSEVOTE_ABI = 0;
}
#endif

namespace posevote::graph {
namespace {

namespace fs = std::filesystem;

struct Loaded {
  std::mutex mutex;
  std::vector<fs::path> files;
  std::vector<fs::path> bundled;               ///< those of them that come with the program
  std::map<std::string, std::string> refused;  ///< of those that come with it: why, by their names
};

Loaded& loaded() {
  static Loaded all;
  return all;
}

/// Why the loader refused it, in the user's words. Where another library is missing that it needs,
/// the message begins with that one's name.
std::string why_refused(const std::string& message, const fs::path& file) {
  if (message.find("undefined symbol: posevote_abi_") != std::string::npos)
    return "built for another version of posevote; build it anew against this one";
  const std::string own = file.string() + ": ";
  return message.starts_with(own) ? message.substr(own.size()) : message;
}

void open_library(const fs::path& file) {
  if (dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) return;
  const char* message = dlerror();
  throw std::invalid_argument("the plugin " + file.string() + ": " +
                              why_refused(message ? message : "it cannot be loaded", file));
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

}  // namespace

namespace {

/// Remembers it in `list`, too, unless that is null.
void load(const fs::path& file, std::vector<fs::path>* list) {
  std::error_code missing;
  const fs::path path = fs::canonical(file, missing);
  if (missing) throw std::invalid_argument("the plugin " + file.string() + ": no such file");
  const std::lock_guard lock(loaded().mutex);
  if (std::count(loaded().files.begin(), loaded().files.end(), path) > 0) return;
  const std::size_t before = detail::count_nodes();
  const std::vector<std::string> taken = detail::names_taken([&path] { open_library(path); });
  if (!taken.empty())
    throw std::invalid_argument("the plugin " + file.string() + ": the name of its node " +
                                listed(taken) + " is taken");
  if (detail::count_nodes() == before)
    throw std::invalid_argument("the plugin " + file.string() + ": it registers no node");
  loaded().files.push_back(path);
  if (list) list->push_back(path);
}

/// Why a node that comes with the program is not there after all; empty for other names.
std::string why_missing(const std::string& node) {
  std::istringstream pairs(POSEVOTE_BUNDLED_NODES);
  for (std::string name, package; pairs >> name >> package;) {
    if (name != node) continue;
    const auto refused = loaded().refused.find("libposevote_" + package);
    return refused == loaded().refused.end()
               ? "it comes with the package posevote-" + package + ", which is not installed"
               : refused->second;
  }
  return "";
}

}  // namespace

void load_plugin(const fs::path& file) { load(file, nullptr); }

std::vector<fs::path> loaded_plugins() {
  const std::lock_guard lock(loaded().mutex);
  std::vector<fs::path> plugins = loaded().files;
  std::erase_if(plugins, [](const fs::path& file) {
    return std::count(loaded().bundled.begin(), loaded().bundled.end(), file) > 0;
  });
  std::sort(plugins.begin(), plugins.end());
  return plugins;
}

std::string file_of(const Wire& plugin) {
  return fs::absolute(fs::path(plugin.where.file).parent_path() / plugin.stream)
      .lexically_normal()
      .string();
}

fs::path this_library() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&this_library), &info) == 0 || !info.dli_fname)
    return "/proc/self/exe";
  std::error_code unknown;
  const fs::path file = fs::canonical(info.dli_fname, unknown);
  return unknown ? fs::path("/proc/self/exe") : file;
}

std::vector<fs::path> code_files() {
  const std::lock_guard lock(loaded().mutex);
  std::vector<fs::path> files = loaded().files;
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), this_library());
  return files;
}

std::string unknown_node(const std::string& name) {
  const std::string is_not_there = "unknown node '" + name + "'";
  if (const std::string why = why_missing(name); !why.empty()) return is_not_there + ", " + why;
  std::vector<std::string> known;
  for (const NodeSpec* other : all_nodes()) known.push_back(other->name);
  const std::string near = did_you_mean(name, known);
  return is_not_there + (near.empty() ? ", `posevote nodes` lists what there is" : near);
}

namespace detail {

void load_bundled() {
  static std::once_flag once;
  std::call_once(once, [] {
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry :
         fs::directory_iterator(this_library().parent_path() / "posevote", none))
      if (entry.path().extension() == ".so") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) try {
        load(file, &loaded().bundled);
      } catch (const std::invalid_argument& error) {
        loaded().refused[file.stem().string()] = error.what();
      }
  });
}

}  // namespace detail
}  // namespace posevote::graph
