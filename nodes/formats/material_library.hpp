// SPDX-License-Identifier: BSD-3-Clause
// Wavefront's libraries of materials (MTL), as far as they say what colour a surface has.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {

struct Material {
  Triple color{1, 1, 1};  ///< in [0, 1], encoded as in sRGB
  std::string image;      ///< its file, relative to the library's; empty: none
};

/// By name. Throws std::runtime_error with the line that is wrong; does not repeat the path.
std::map<std::string, Material> read_materials(const std::filesystem::path& file);

}  // namespace posevote::formats
