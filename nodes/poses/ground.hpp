// SPDX-License-Identifier: BSD-3-Clause
// The ground on which things stand: the largest plane that a scan shows. A pose with much of the
// model below it, where the ground is seen all around, is that of something lower: a carton put on
// a box that is half as high.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "nodes/data/cloud.hpp"
#include "nodes/data/model.hpp"
#include "nodes/geometry/range_view.hpp"

namespace posevote::poses {

class Ground {
 public:
  /// `depth`: how far below the plane the ground begins [m]; so far its points may be off, too.
  /// There is none where no plane has a twentieth of the scan's points.
  Ground(const Cloud& scan, float depth);

  /// The share of the posed model's points that lie in the ground; of some 1000, evenly chosen. 0
  /// where the ground is not seen beside where the model would go into it (in the recesses of
  /// trays, beyond edges, behind other things), or the sensor saw deeper where the model would be (a
  /// plane that happens to lie on many things). Nor is there ground for what may be the plane itself:
  /// what does not rise above it (in a bin full of cartons their lids are the largest plane), or is
  /// as large as it (a scan whose background is cut away shows the object's own faces alone).
  double share_inside(const Model& model, const Eigen::Isometry3d& T_scene_model,
                      const geometry::RangeView& view) const;

  /// Of two poses of a model at one place: how much deeper the other reaches into the ground on which
  /// the one stands, in multiples of what its plane may be off; less than 0 where the other stands,
  /// 0 where neither does, or both do. Whether the ground is seen beside the model is not asked: under
  /// what stands on it, it is there.
  double lead_over(const Model& model, const Eigen::Isometry3d& one,
                   const Eigen::Isometry3d& other) const;

  using Plane = Eigen::Hyperplane<float, 3>;
  struct Extent {
    Plane plane;       ///< normal up, to the sensor
    float radius = 0;  ///< root mean square distance of its points from their mean [m]
  };

 private:
  /// The height of a posed model's lowest point over the plane [m]; none where there is no ground
  /// for it.
  std::optional<float> lowest_of(const Model& model, const Eigen::Isometry3f& T_scene_model) const;

  /// How far the posed model reaches below the plane, beyond what that may be off, in multiples of it;
  /// 0 where it stands on it, and nothing where it does neither: it lies on other things.
  std::optional<float> depth_below(const Model& model,
                                   const Eigen::Isometry3d& T_scene_model) const;

  /// Lines of sight on which the ground was seen, or something deeper.
  struct Sights {
    float seen = 0, gone = 0;
  };
  /// Along that to a place.
  void look(const Eigen::Vector3f& place, const geometry::RangeView& view, Sights& sights) const;
  bool is_seen_around(const Plane& plane, const Cloud& model,
                      const Eigen::Isometry3f& T_scene_model,
                      const geometry::RangeView& view) const;

  float depth_;
  Eigen::Vector3f viewpoint_;
  std::optional<Extent> extent_;
};

}  // namespace posevote::poses
