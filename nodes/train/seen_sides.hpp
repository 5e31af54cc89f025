// SPDX-License-Identifier: BSD-3-Clause
// Which samples of a mesh, and which sides of them, can be seen from afar at all.
#pragma once

#include <string>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/face_samples.hpp"
#include "nodes/geometry/winding.hpp"

namespace posevote::train {

struct Visibility {
  std::string two_sided = "auto";  ///< always, never; auto: parts seen as well from behind
  double as_open = 0.4;            ///< auto: least openness of the one side, x that of the other
  bool hidden = false;             ///< keep samples that cannot be seen
};

/// The samples with the sides from which they can be seen; one that is seen from both comes twice,
/// the second time with its normal turned. `samples` are of `mesh.faces`; `colors`: theirs, or none.
///
/// Rays from a part's samples into all directions of the sphere tell how open either side is. A
/// part whose back is the open one is turned; one that is open on both is a sheet. Where there are
/// several parts, a sample goes that no ray leaves on its side: it lies within the body, as the
/// walls between the solids of an assembly. One closed part needs no rays. Samples x some 5 rays;
/// 64 for those within.
Cloud keep_seen(const PointMatrix& points, const geometry::WoundFaces& mesh,
                const geometry::FaceSamples& samples, const ColorMatrix& colors,
                const Visibility& how);

}  // namespace posevote::train
