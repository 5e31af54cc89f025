// SPDX-License-Identifier: BSD-3-Clause
// Where a posed model's faces end and where the scan's do, as pairs for ICP. A flat face slides
// along itself under point-to-plane ICP; its ends hold it (Drost, Ilic 2012 match the edges of range
// images). An end is looked for in the surface alone, so that it needs no image: from a model
// point at the rim of a face, along the face, in the model and in the scan by like rules, so that
// what they leave out at both cancels.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/data/model.hpp"
#include "nodes/geometry/icp_pairs.hpp"
#include "nodes/geometry/near_surface.hpp"
#include "nodes/geometry/range_view.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {

/// Constants of the method; poses/term_params.cpp says where they come from. Lengths x resolution.
struct EdgeTerms {
  int ends = 1000;    ///< of a model that are looked at, at most; 0: none
  double reach = 12;  ///< how far from the model's end the scan's may be
  double spread = 1;  ///< by which an end is off, one deviation
};

/// At most so many, evenly strewn. `index`: of the model's points. `resolution`: of the model and of the scan [m].
std::vector<FaceEnd> find_face_ends(const Cloud& model, const SurfaceIndex& index,
                                    const Outline& outline, float resolution, int most);

/// The ends of a model's faces in a scan. Keeps references to all that it is given.
class FaceEnds {
 public:
  /// `resolution`: that of `ends` [m].
  FaceEnds(const Cloud& model, const std::vector<FaceEnd>& ends, const ScanSurface& scan,
           const RangeView& view, float resolution, const EdgeTerms& terms);

  /// The ends that face the sensor and that the scan has, too, before free space, each held along its
  /// face. Their weights are those of points on planes, whose residuals have this variance [m^2], by
  /// how much more exactly planes hold.
  std::vector<IcpPair> pairs(const Eigen::Isometry3d& T_scene_model, double variance) const;

 private:
  IcpPair pair_of(const FaceEnd& end, const Eigen::Isometry3f& T_scene_model) const;
  /// Whether what ends before that place is not cut off by something nearer, and does not go on as
  /// another face: near an edge between two faces normals are means of both, and each seems to end
  /// too early.
  bool is_free(const Eigen::Vector3f& beyond) const;

  const Cloud& model_;
  const std::vector<FaceEnd>& ends_;
  const ScanSurface& scan_;
  const RangeView& view_;
  float resolution_, step_, reach_;
  double spread_;
};

}  // namespace posevote::geometry
