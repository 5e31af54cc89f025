// SPDX-License-Identifier: BSD-3-Clause
// What all descriptors have in common: the check before, the loop, and the choice after.
#pragma once

#include <functional>
#include <vector>

#include "nodes/data/features.hpp"
#include "nodes/geometry/grid.hpp"

namespace posevote::descriptors {

/// Throws std::runtime_error if the cloud has no normals, a feature point is not in the cloud, or the
/// scale is not positive.
void require_describable(const Cloud& cloud, const FeaturePoints& points, const Scale& scale);

/// Whether the feature point has a finite position and a unit normal, at least roughly.
bool is_oriented(const Cloud& cloud, std::uint32_t point);

/// The feature points whose descriptor could be computed, row i of `descriptors` belonging to
/// points.indices[i]. A row that is not finite is left out too. There may be none. Parallel.
FeatureSet keep_described(const Cloud& cloud, const FeaturePoints& points,
                          DescriptorMatrix descriptors, const std::vector<char>& described);

/// The neighbourhoods that a descriptor looks at, in one cloud. Keeps references to its arguments.
class Support {
 public:
  /// `radius`: multiples of the resolution. `step`: only every so many points of the cloud are
  /// neighbours. Throws what require_describable throws.
  Support(const Cloud& cloud, const FeaturePoints& points, const Scale& scale, double radius,
          int step = 1);

  const Cloud& cloud() const { return cloud_; }
  const FeaturePoints& points() const { return points_; }
  const Cloud& neighbours() const { return some_.points.rows() > 0 ? some_ : cloud_; }
  const geometry::PointGrid& grid() const { return grid_; }  ///< of the neighbours
  float resolution() const { return resolution_; }           ///< [m]
  float radius() const { return radius_; }                   ///< [m]

  /// Calls describe(point, descriptor) in parallel for every oriented feature point, `descriptor`
  /// being `length` numbers to write; where it returns false the point is left out.
  FeatureSet describe_each(
      int length,
      const std::function<bool(std::uint32_t point, float* descriptor)>& describe) const;

 private:
  const Cloud& cloud_;
  const FeaturePoints& points_;
  float resolution_;
  float radius_;
  Cloud some_;  ///< empty: all are neighbours
  geometry::PointGrid grid_;
};

}  // namespace posevote::descriptors
