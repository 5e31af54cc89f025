// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/texture.hpp"

namespace posevote::color {

/// The light of the pixel at a place of an image (texture.hpp).
Eigen::RowVector3f texture_color(const ColorImage& image, const Eigen::RowVector2f& place);

/// Whether anything is known of a mesh's colours.
bool is_colored(const Mesh& mesh);

/// The light at a point of a face, given by the weights of its corners: by its texture, else
/// between the colours of its corners. The mesh must be coloured.
Eigen::RowVector3f face_color(const Mesh& mesh, const Eigen::Matrix<std::uint32_t, 1, 3>& corners,
                              const Eigen::RowVector3f& weights);

/// One colour a point; 0 x 3 where there are none.
ColorMatrix point_colors(const Mesh& mesh);

}  // namespace posevote::color
