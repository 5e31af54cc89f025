// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::formats {

using Rgb = std::array<std::uint8_t, 3>;

/// An image, beside the file, and where in it the corners of each face lie: u, v (texture.hpp).
struct FaceTexture {
  std::string image;  ///< its file's name; empty: none
  Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor> places{};  ///< one row a face
};

/// Writes a binary little-endian PLY: the points times `units_per_metre`, and the normals, faces
/// and colours that there are (colours: none, or one a point, or a texture). The file appears whole or not at
/// all. Throws std::runtime_error naming it if it cannot be written, and std::invalid_argument
/// where the counts contradict each other.
void write_ply(const std::filesystem::path& file, const Mesh& mesh, double units_per_metre = 1,
               const std::vector<Rgb>& colours = {}, const FaceTexture& texture = {});

}  // namespace posevote::formats
