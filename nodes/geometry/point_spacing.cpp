// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/point_spacing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/data/splitmix64.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/extent.hpp"
#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/plane_fit.hpp"
#include "nodes/geometry/select_rows.hpp"

namespace posevote::geometry {
namespace {

constexpr double kOutliers = 0.05;  // of the points, at either end of each axis

using Place = std::array<float, 3>;

/// Of the places alone, not of the unit: the same for places twice as far out.
std::uint64_t hash_of(const Place& place) {
  constexpr std::uint32_t kFraction = 0x007FFFFF;
  const auto bits = [&](std::size_t axis) -> std::uint64_t {
    return std::bit_cast<std::uint32_t>(place[axis]) & kFraction;
  };
  return splitmix64(splitmix64(bits(0) << 32 | bits(1)) ^ bits(2));
}

/// The finite points; of many only about `most`, chosen by where they are: neither their order nor
/// the columns of an image play a part.
std::vector<Place> places_of(const PointMatrix& points, std::size_t most) {
  const std::vector<std::uint32_t> finite = finite_rows(points);
  const std::size_t step = std::max<std::size_t>(1, finite.size() / most);
  return joined_ranges(finite.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Place> places;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = finite[k];
      const Place place{points(i, 0), points(i, 1), points(i, 2)};
      if (step == 1 || hash_of(place) % step == 0) places.push_back(place);
    }
    return places;
  });
}

void keep_one_each(std::vector<Place>& places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

/// Whether the places are hardly any twice.
bool seem_distinct(std::vector<Place> sample) {
  const std::size_t all = sample.size();
  keep_one_each(sample);
  return 20 * sample.size() >= 19 * all;
}

PointMatrix matrix_of(const std::vector<Place>& places) {
  PointMatrix points(std::ssize(places), 3);
  for (std::size_t i = 0; i < places.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector3f::Map(places[i].data());
  return points;
}

/// The finite points, each place once.
PointMatrix distinct(const PointMatrix& points) {
  std::vector<Place> places = places_of(points, std::numeric_limits<std::size_t>::max());
  keep_one_each(places);
  return matrix_of(places);
}

/// Tells which points may lie within a reach of some places: all that do, and a few others. Asked
/// of every point, which costs far less than an index of all for a few places.
class Vicinity {
 public:
  /// `reach` [m] > 0
  Vicinity(const std::vector<Eigen::Vector3f>& places, float reach) {
    for (const Eigen::Vector3f& place : places) box_.extend(place.cast<double>());
    const double margin = 1.00001 * static_cast<double>(reach);  // rounding
    box_ = {box_.min().array() - margin, box_.max().array() + margin};
    per_cell_ = 1 / std::max(margin, box_.sizes().maxCoeff() / 1e9);  // cells below 2^30
    marks_.resize(std::bit_ceil(kMarksPerPlace * places.size()) / 64, 0);
    for (const Eigen::Vector3f& place : places) mark_around(place);
  }

  bool may_hold(const Eigen::Vector3f& point) const {
    const Eigen::Vector3d place = point.cast<double>();
    if (!box_.contains(place)) return false;  // nor NaN
    const std::size_t bit = bit_of(cell_of(place));
    return (marks_[bit / 64] >> (bit % 64) & 1U) != 0;
  }

 private:
  using Cell = Eigen::Array<std::int64_t, 3, 1>;
  static constexpr std::size_t kMarksPerPlace = 512;  // of which 27 are set

  Cell cell_of(const Eigen::Vector3d& place) const {
    return ((place - box_.min()).array() * per_cell_).cast<std::int64_t>();
  }
  std::size_t bit_of(const Cell& cell) const {
    const auto key = static_cast<std::uint64_t>((cell.z() << 30 ^ cell.y() << 15) ^ cell.x());
    return scatter(key, 64 * marks_.size() - 1);
  }
  void mark_around(const Eigen::Vector3f& place) {
    const Cell cell = cell_of(place.cast<double>());
    for (int i = 0; i < 27; ++i) {
      const std::size_t bit = bit_of(cell + Cell(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
      marks_[bit / 64] |= std::uint64_t{1} << (bit % 64);
    }
  }

  Eigen::AlignedBox3d box_;  ///< around all that is within reach
  double per_cell_ = 1;
  std::vector<std::uint64_t> marks_;  ///< bits; a power of two
};

/// Of each place the squared distance to the nearest point that is not there; infinite where that
/// is not within `reach`.
std::vector<float> nearest_within(const PointMatrix& points,
                                  const std::vector<Eigen::Vector3f>& places, float reach) {
  const Vicinity vicinity(places, reach);
  const auto rows = rows_that(static_cast<std::size_t>(points.rows()), [&](std::uint32_t i) {
    return vicinity.may_hold(points.row(i).transpose());
  });
  const PointGrid grid(rows_of(points, rows), reach);
  std::vector<float> nearest(places.size(), std::numeric_limits<float>::infinity());
  graph::parallel_for(places.size(), 32, [&](std::size_t i) {
    grid.for_each_within(places[i], reach, [&least = nearest[i]](std::uint32_t, float squared) {
      if (squared > 0) least = std::min(least, squared);
    });
  });
  return nearest;
}

}  // namespace

float point_spacing(const PointMatrix& points) {
  std::vector<Place> sample = places_of(points, kSample);
  // A place that holds thousands of points must not make the sample, nor leave it empty; few scans
  // have one.
  PointMatrix once;
  if (sample.size() < 2 || !seem_distinct(sample)) {
    once = distinct(points);
    sample = places_of(once, kSample);
  }
  const PointMatrix& all = once.rows() > 0 ? once : points;
  std::vector<Eigen::Vector3f> places;  // whose nearest is not found yet
  for (const Place& place : sample) places.emplace_back(Eigen::Vector3f::Map(place.data()));
  if (places.size() < 2) return 0;
  const auto diagonal = static_cast<float>(robust_diagonal(matrix_of(sample), kOutliers));
  std::vector<float> distances;
  // At first half of what a point would fill if they filled the largest side of the box around
  // most (far outliers must not set it): about what they are apart.
  float reach = 0.5F * diagonal / std::sqrt(static_cast<float>(all.rows()));
  // Once most are found: the rest, farther from theirs, do not move the median.
  for (; 2 * distances.size() <= sample.size() && reach < 4 * diagonal; reach *= 2) {
    const std::vector<float> nearest = nearest_within(all, places, reach);
    std::vector<Eigen::Vector3f> left;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (std::isfinite(nearest[i]))
        distances.push_back(std::sqrt(nearest[i]));
      else
        left.push_back(places[i]);
    places = std::move(left);
  }
  distances.resize(sample.size(), std::numeric_limits<float>::infinity());
  const float spacing = upper_median(std::move(distances));
  return std::isfinite(spacing) ? spacing : 0;
}

}  // namespace posevote::geometry
