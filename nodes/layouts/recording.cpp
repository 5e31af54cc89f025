// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/recording.hpp"

#include <map>
#include <stdexcept>

#include "nodes/formats/format.hpp"

namespace posevote::layouts {
namespace {

std::map<std::string, Recording>& registry() {
  static std::map<std::string, Recording> recordings;  // filled before main by their own files
  return recordings;
}

}  // namespace

bool register_recording(const Recording& recording) {
  if (!registry().emplace(recording.name, recording).second)
    throw std::logic_error("two recordings are registered as '" + recording.name + "'");
  return true;
}

const Recording* find_recording(const std::filesystem::path& path) {
  std::error_code is_loop;  // of links
  if (!std::filesystem::is_directory(path, is_loop) &&
      !std::filesystem::exists(formats::container_of(path), is_loop))
    return nullptr;
  for (const auto& [name, recording] : registry())
    if (recording.recognises(path)) return &recording;
  return nullptr;
}

}  // namespace posevote::layouts
