// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::formats {

using Rgb = std::array<std::uint8_t, 3>;

/// Writes a binary little-endian PLY: the points times `units_per_metre`, and the normals, faces
/// and colours that there are (colours: none, or one a point). The file appears whole or not at
/// all. Throws std::runtime_error naming it if it cannot be written, and std::invalid_argument
/// where the counts contradict each other.
void write_ply(const std::filesystem::path& file, const Mesh& mesh, double units_per_metre = 1,
               const std::vector<Rgb>& colours = {});

}  // namespace posevote::formats
