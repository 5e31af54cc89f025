// SPDX-License-Identifier: BSD-3-Clause
// What the readers of depth images hand over: numbers as they stand in the file. Whole ones are in
// the camera's unit; floating-point ones, by the custom of those who write them, in metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace posevote::formats {

struct DepthImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint16_t> values{};  ///< raw, row by row; one of the two is empty
  std::vector<float> metres{};          ///< 0 or not finite: no measurement
};

/// Depths along the optical axis [m], row by row; 0 or not finite: no measurement.
/// millimetres_per_unit: of raw values.
std::vector<float> depths_of(const DepthImage& image, double millimetres_per_unit);

/// The ending says how. Throws std::runtime_error that says what is wrong, but does not repeat the
/// path.
DepthImage read_depth_image(const std::filesystem::path& path);

}  // namespace posevote::formats
