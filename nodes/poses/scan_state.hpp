// SPDX-License-Identifier: BSD-3-Clause
// The scan as the segmentation goes on: what has been explained, what is left.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/data/model.hpp"
#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/range_view.hpp"
#include "nodes/geometry/scan_surface.hpp"
#include "nodes/poses/candidate.hpp"
#include "nodes/poses/color_fit.hpp"
#include "nodes/poses/company.hpp"
#include "nodes/poses/ground.hpp"
#include "nodes/poses/solid.hpp"
#include "nodes/poses/terms.hpp"
#include "nodes/poses/usual_residual.hpp"

namespace posevote::poses {

/// What is known of the things in a scan.
struct Acquaintance {
  std::size_t kinds = 0;           ///< that are looked for; 0: that is not asked, all are
  std::vector<Companion> found{};  ///< instances that are believed
};

struct ScanState {
  /// Keeps references to scan and features.
  ScanState(const Cloud& scan, const FeatureSet& scan_features, float resolution_m,
            const Terms& terms = {}, std::size_t kinds = 0);

  /// Takes what a posed model explains, up to `distance` [m] from its surface, out of the scan's
  /// points and features. Free space stays what it is: `view` keeps all points.
  void take_out(const Model& model, const Eigen::Isometry3d& T_scene_model, float distance);
  /// How many features of these octaves that nothing explained yet would a posed model explain.
  /// `grid`: of the model's points.
  std::size_t count_explained(const Model& model, const geometry::SurfaceIndex& index,
                              const Eigen::Isometry3d& T_scene_model, float distance,
                              const std::vector<Octave>& octaves) const;
  /// Whether points or features that were left when `takes` was `since` have gone, as far as these
  /// lie within `radius` of a box [m]. Never false where they do.
  bool changed_since(int since, const Eigen::AlignedBox3d& box, double radius) const;

  /// An instance tells what is usual in this scan, by which others are judged, and where no other
  /// can be. Keeps a reference to the model.
  void learn_from(const Model& model, const Candidate& instance);
  /// The share of a posed model's surface that lies in instances.
  double share_inside(const Model& model, const Eigen::Isometry3d& T_scene_model) const;

  /// How far a posed model's centre is from the sensor [m].
  double range_of(const Model& model, const Eigen::Isometry3d& T_scene_model) const;

  const Cloud& cloud;
  const FeatureSet& features;
  float resolution;  // [m]
  geometry::RangeView view;
  geometry::ScanSurface surface;
  Ground ground;
  std::vector<char> feature_explained;  // per scene feature
  int takes = 0;                        // how often something was taken out
  UsualResidual usual_residual;         // of what was found
  UsualTint usual_tint;                 // of what was found
  LookOf look;
  Acquaintance known;

 private:
  std::vector<Eigen::AlignedBox3d> gone_;  // what each take took out lies in
  std::vector<Solid> solids_;
};

}  // namespace posevote::poses
