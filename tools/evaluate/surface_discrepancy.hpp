// SPDX-License-Identifier: BSD-3-Clause
// VSD, the visible surface discrepancy of Hodan, Matas, Obdrzalek (ECCVW 2016), as in BOP 2018 and
// BOP 2019: how far apart the surfaces are that two poses would show, where they can be seen.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/layouts/ground_truth.hpp"

namespace posevote {

/// Distances from the camera's centre [m] in a window of the image; 0: nothing there.
struct RangeImage {
  int x = 0, y = 0, width = 0, height = 0;  ///< the window
  std::vector<float> ranges;                ///< row by row
  float at(int u, int v) const {
    const bool inside = u >= x && u < x + width && v >= y && v < y + height;
    return inside ? ranges[static_cast<std::size_t>((v - y) * width + u - x)] : 0.0F;
  }
};

/// The measured ranges. Throws std::runtime_error naming the file.
RangeImage read_range_image(const layouts::TrueImage& image);

/// What a camera with an image of that size sees of the model (z-buffer; integer coordinates are
/// pixel centres). Triangles that reach behind the camera are left out.
RangeImage render(const layouts::TrueObject& object, const Eigen::Isometry3d& T_camera_model,
                  const Camera& camera, int width, int height);

enum class Holes { visible, hidden };  ///< pixels without a measurement: BOP 2019, BOP 2018

/// VSD for each misalignment tolerance tau [m], in [0, 1]. `delta`: how far a surface may lie
/// behind the measured one and still be visible [m].
std::vector<double> surface_discrepancy(const RangeImage& measured, const RangeImage& of_true,
                                        const RangeImage& of_found, double delta, Holes holes,
                                        const std::vector<double>& taus);

}  // namespace posevote
