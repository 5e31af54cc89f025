// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// A smooth function of space, negative inside the body.
using Field = std::function<double(const Eigen::Vector3d&)>;

/// The field's zero surface inside the cube [-extent, extent]^3 as a closed mesh with outward
/// winding: naive surface nets (Gibson 1998) on cubic cells of edge `cell`, one vertex for each
/// cell that the surface passes, then moved onto the surface along the gradient. The field must be
/// positive within two cells of the cube's border. Details smaller than two cells are lost.
/// O((extent / cell)^3).
Mesh surface_nets(const Field& field, double extent, double cell);

}  // namespace posevote
