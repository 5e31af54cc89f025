// SPDX-License-Identifier: BSD-3-Clause
// Where a posed model's surface turns away from the sensor and where the scan's does, as pairs for
// ICP. Of a can the sensor sees the front, and less of it than there is: such a front fits a little
// to the left or right as well. Free space tells: the model's contour must not stand before what the
// sensor saw behind it, nor lie within the scan's. Between the last that was seen of the object and
// the first that was seen behind it is often nothing (sensors lose edges), so a contour is held by
// no place but by that interval. (Contours of range images in ICP: Drost, Ilic 2012. Where faces end
// at edges, edge_pairs.hpp.)
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/icp_pairs.hpp"
#include "nodes/geometry/range_view.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::geometry {

/// Constants of the method; poses/term_params.cpp says where they come from.
struct ContourTerms {
  int points = 4000;    ///< of a model that are looked at, about; 0: none
  double reach = 6;     ///< x resolution: how far from the model's contour the scan's may be
  double spread = 0.5;  ///< x resolution: by which a contour is off, one deviation
};

/// The points of a posed model at its contour, each held across the line of sight. None where the
/// view does not tell free space. `resolution`: of the scan [m]; `variance`: of the residuals of
/// points on planes [m^2], by which contours are weighed against them.
std::vector<IcpPair> contour_pairs(const Cloud& model, const ScanSurface& scan,
                                   const RangeView& view, const Eigen::Isometry3d& T_scene_model,
                                   float resolution, double variance, const ContourTerms& terms);

}  // namespace posevote::geometry
