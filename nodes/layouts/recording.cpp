// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/recording.hpp"

#include <map>
#include <stdexcept>

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

const Recording* find_recording(const std::filesystem::path& folder) {
  for (const auto& [name, recording] : registry())
    if (recording.recognises(folder)) return &recording;
  return nullptr;
}

}  // namespace posevote::layouts
