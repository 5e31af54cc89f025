// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "nodes/adapters/pcl_surface.hpp"

namespace posevote::describe {

/// Triangles between neighbouring points of a surface, as indices into it, each once and sorted.
///
/// Each point is joined with those of its neighbours that a Delaunay triangulation of their
/// projections to its tangent plane would join it with, where the triangle's circumscribed circle
/// is no larger than `circumradius` [m]. The stars of neighbouring points may disagree, so this is
/// no manifold mesh; but it covers the surface, does not depend on the order of points (but for
/// ties), and is found in parallel. Neighbours whose normal is turned by more than 60 deg count as
/// another surface.
std::vector<std::array<int, 3>> local_triangles(const adapters::PclSupport& support,
                                                float circumradius);

}  // namespace posevote::describe
