// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "nodes/data/cloud.hpp"
#include "nodes/data/files.hpp"

namespace posevote::load {

/// Which depths to take [m]; far = 0: no limit.
struct DepthRange {
  double near = 0;
  double far = 0;
  std::size_t most_pixels = 0;  ///< of a file; 0: no limit
};

/// The points that a depth image measured, row by row: x right, y down, z forward, the camera at the
/// origin. Integer pixel coordinates are pixel centres. `color`: of the same pixels, or null, whatever
/// the image has. Throws std::runtime_error that says what is wrong.
Scan points_of(const LoadedDepth& image, const ColorImage* color, const Camera& camera,
               const DepthRange& range);

/// The depths of a file, 0 being no measurement. The error does not repeat the path.
LoadedDepth read_depth(const std::filesystem::path& path, const Camera& camera,
                       const DepthRange& range);

/// The colours of the same pixels. The error does not repeat the path.
std::shared_ptr<const ColorImage> read_colors(const std::filesystem::path& path,
                                              const LoadedDepth& depth);

}  // namespace posevote::load
