// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/format.hpp"

#include <cctype>
#include <map>
#include <memory>
#include <stdexcept>

namespace posevote::formats {
namespace {

using ByEnding = std::map<std::string, std::shared_ptr<const Format>>;

ByEnding& registry() {
  static ByEnding formats;  // filled before main by the formats' own files
  return formats;
}

bool is_wanted(const Format& format, Wanted wanted) {
  return wanted == Wanted::kAny || format.holds_depth() == (wanted == Wanted::kDepthImages);
}

const Format* by_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = registry().find(ending);
  return found == registry().end() ? nullptr : found->second.get();
}

}  // namespace

bool register_format(const std::string& name, const std::vector<std::string>& endings,
                     std::variant<ReadMesh, ReadDepth> read, ReadEntry entry) {
  const auto format = std::make_shared<const Format>(Format{name, endings, read, entry});
  for (const std::string& ending : endings) {
    const auto [taken, is_new] = registry().emplace(ending, format);
    if (!is_new)
      throw std::logic_error(name + " and " + taken->second->name + " both claim '" + ending + "'");
  }
  return true;
}

const Format* find_format(const std::filesystem::path& file) { return by_ending(file_of(file)); }

std::filesystem::path container_of(const std::filesystem::path& path) {
  std::filesystem::path outermost;
  std::error_code none;
  for (std::filesystem::path at = path; at.has_relative_path(); at = at.parent_path()) {
    const Format* format = by_ending(at);
    if (format && format->entry && !std::filesystem::is_directory(at, none)) outermost = at;
  }
  return outermost;
}

std::filesystem::path file_of(const std::filesystem::path& path) {
  const std::filesystem::path container = container_of(path);
  return container.empty() ? path : container;
}

bool has_ending(const std::filesystem::path& file, Wanted wanted) {
  const Format* format = find_format(file);
  return format && is_wanted(*format, wanted);
}

std::string list_endings(Wanted wanted) {
  std::vector<std::string> endings;
  for (const auto& [ending, format] : registry())
    if (is_wanted(*format, wanted) && (wanted == Wanted::kAny || !format->entry))
      endings.push_back(ending);
  std::string text;
  for (std::size_t i = 0; i < endings.size(); ++i)
    text += (i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ") + endings[i];
  return text;
}

}  // namespace posevote::formats
