// SPDX-License-Identifier: BSD-3-Clause
// Images of colours, as they are on disk: what a camera saw, or what is painted on a model's faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// Row by row, three bytes a pixel: red, green, blue (sRGB).
struct ColorImage {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> values;
};

/// What is painted on a mesh: where each of its points lies in an image. Points in one place that
/// lie in several (a seam) are several points.
struct Texture {
  std::vector<ColorImage> images;
  Eigen::Matrix<float, Eigen::Dynamic, 2> places;  ///< per point: u from the left, v from the
                                                   ///< bottom, 1 at the border; it repeats beyond
  std::vector<std::uint32_t> image_of;             ///< per point
};

}  // namespace posevote
