// SPDX-License-Identifier: BSD-3-Clause
// How well a posed model agrees with what the sensor measured. Every model point that turns its
// outside to the sensor gets one verdict:
//
//   supported     a scan point lies within the tolerance and its normal agrees
//   contradicted  the sensor saw through the point to a surface clearly behind it
//   mismatched    a surface was measured there, but not this one: other orientation, or already
//                 explained by another detection
//   unseen        nothing was measured in that direction
//   hidden        a measured surface stands before the point, or it is beside the sensor's image:
//                 says nothing
//
// And where the model's surface ends beside a supported point, the scan's may end, too, or go on
// (overhang); so where it has a hole, a slot or teeth. One nearest-neighbour search a point, and one
// for each end.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/outline.hpp"
#include "nodes/geometry/range_view.hpp"
#include "nodes/geometry/scan_surface.hpp"
#include "nodes/poses/terms.hpp"

namespace posevote::poses {

/// How large what takes a side looks from the sensor, in points seen head-on: a point counts by the
/// cosine between its normal and the way there. Of a grazing side a sensor measures few points, and
/// those badly, so it must not outvote a face that is seen whole.
struct Sides {
  double supported = 0, contradicted = 0;
  double mismatched = 0;  ///< or unseen, but for what looks too grazing to be measured
  double at_bends = 0;    ///< of all these, what lies at a bend of the model that shows both faces
  double mismatched_at_bends = 0;

  /// At a bend the scan's normals are those of neither face. What bends all over forgives nothing.
  double against(const FitTerms& terms) const {
    const double all = supported + contradicted + mismatched;
    const double straight = all > 0 ? 1 - at_bends / all : 0;
    const double forgiven = terms.bends_forgiven * straight * mismatched_at_bends;
    return contradicted + terms.mismatch_weight * (mismatched - forgiven);
  }
};

struct Fit {
  std::size_t facing = 0;  ///< all of the below
  std::size_t supported = 0, contradicted = 0, mismatched = 0, unseen = 0, hidden = 0;
  std::size_t outside = 0;           ///< of the hidden, what lies beside the image
  Sides apparent;                    ///< of these
  std::size_t ends = 0;              ///< places beside the supported where the model's surface ends
  std::size_t overhang = 0;          ///< of those, where the scan's surface goes on
  std::size_t gaps = 0, filled = 0;  ///< the same of gaps (Outline), where they are looked into
  std::size_t holes = 0, filled_holes = 0;  ///< of those, of gaps behind which the model goes on
  double inlier_fraction = 0;               ///< supported / facing
  double rmse = 0;                          ///< point to plane, over the supported [m]
  /// What patches of the scan lie off by, not noise, of a pose that may be right [m]
  /// (systematic_residual.hpp), and what noise alone may leave there (Shared); not of measure_fit.
  double systematic = 0, systematic_doubt = 0;
  double relief = 0;      ///< of the supported: 0 if all normals are parallel, 2/3 at most
  double stands_for = 1;  ///< so many of the model's points stand for each that was judged
};

/// Which points of the model are judged, and how closely.
struct Sampling {
  Eigen::Index points = 0;  ///< about so many, evenly strewn; 0: all
  bool closely = false;     ///< its gaps, too, for a confidence
};

/// `tolerance`: of support; a surface is clearly behind or before at clear_distance times that [m].
/// `outline` is the model's.
Fit measure_fit(const Cloud& model, const Outline& outline, const geometry::ScanSurface& scan,
                const geometry::RangeView& view, const Eigen::Isometry3d& T_scene_model,
                float tolerance, const Sampling& sampling = {}, const FitTerms& terms = {});

/// The same by the range image alone, a projection for each of about so many `points`: supported is
/// what faces the sensor at the range that it measured there. Nothing is known of residuals and ends.
Fit measure_by_range(const Cloud& model, const geometry::ScanSurface& scan,
                     const geometry::RangeView& view, const Eigen::Isometry3d& T_scene_model,
                     float tolerance, Eigen::Index points, const FitTerms& terms = {});

/// What some points say of a pose.
struct Evidence {
  double balance = 0;     ///< those for it less those against it
  std::size_t sides = 0;  ///< those that take a side
};

/// By the model's points with these numbers. Of a side so grazing that a sensor may miss it, what is
/// not supported says nothing.
Evidence weigh_points(const Cloud& model, const std::vector<std::uint32_t>& points,
                      const geometry::ScanSurface& scan, const geometry::RangeView& view,
                      const Eigen::Isometry3d& T_scene_model, float tolerance,
                      const FitTerms& terms = {});

/// How much more speaks for one than for the other, in standard deviations, were the points
/// independent.
double lead_of(const Evidence& one, const Evidence& other);

/// What a fit comes to, each in [0, 1] but where the outline speaks against itself.
struct FitShares {
  double agreement = 0;   ///< of the points that take a side, those for the pose
  double outline = 0;     ///< of all looks beside the supported, those that met the model's outline
                          ///< where the scan's is, less those where the scan goes on
  double continuity = 1;  ///< of the outline, where the scan ends, too
  double gaps = 0;        ///< like outline, of gaps
};

/// Of a fit that has supported points.
FitShares shares_of(const Fit& fit, const FitTerms& terms = {});

/// In [0, 1]: how much of what should be visible is there, times how much there is to go by;
/// fit_quality.cpp gives the reasons.
double fit_quality(const Fit& fit, const FitTerms& terms = {});

}  // namespace posevote::poses
