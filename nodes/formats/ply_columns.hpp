// SPDX-License-Identifier: BSD-3-Clause
// Which of a PLY file's properties say what.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "nodes/formats/ply_header.hpp"

namespace posevote::formats {

/// Positions of a vertex's properties: each group is there as a whole or not at all.
struct PlyColumns {
  std::array<std::size_t, 3> point{};
  std::optional<std::array<std::size_t, 3>> normal, color;
  std::optional<std::array<std::size_t, 2>> place;  ///< in an image
  double brightest = 1;                             ///< what colours of that type are shares of
  std::string color_doubt;                          ///< why there are none, though some are named
};

/// Throws std::runtime_error where x, y or z is missing.
PlyColumns find_columns(const PlyElement& vertex);

/// Positions of a face's properties; SIZE_MAX where there is none.
struct PlyFaceColumns {
  std::size_t corners = SIZE_MAX;
  std::size_t places = SIZE_MAX;  ///< of the corners in an image
  std::size_t image = SIZE_MAX;   ///< the number of that image
};

/// Throws std::runtime_error where the corners are no list.
PlyFaceColumns find_face_columns(const PlyElement& face);

}  // namespace posevote::formats
