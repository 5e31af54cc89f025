// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/plane_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/data/splitmix64.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/plane_moments.hpp"

namespace posevote::geometry {
namespace {

constexpr float kMergePerRadius = 1.0F / 5;

std::vector<float> weights_of(const Voxels& voxels, const PointGrid& grid) {
  std::vector<float> weights(voxels.size() + kGridPadding, 0);
  for (std::size_t i = 0; i < grid.size(); ++i)
    weights[i] = static_cast<float>(voxels[grid.indices()[i]].size());
  return weights;
}

/// Diagonal of the box that leaves out a twentieth of the points at either end of each axis.
float middle_diagonal(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3f extent;
  const std::size_t cut = points.size() / 20;
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(),
                   [axis](const Eigen::Vector3f& point) { return point(axis); });
    std::sort(values.begin(), values.end());
    extent(axis) = values[values.size() - 1 - cut] - values[cut];
  }
  return extent.stableNorm();
}

using Place = std::array<float, 3>;

std::uint64_t hash_of(const Place& place) {
  const std::uint64_t x = std::bit_cast<std::uint32_t>(place[0]);
  const std::uint64_t y = std::bit_cast<std::uint32_t>(place[1]);
  return splitmix64(splitmix64(x << 32 | y) ^ std::bit_cast<std::uint32_t>(place[2]));
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

/// The finite points, each place once.
PointMatrix distinct(const PointMatrix& points) {
  std::vector<Place> places = places_of(points, std::numeric_limits<std::size_t>::max());
  keep_one_each(places);
  PointMatrix once(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i)
    once.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector3f::Map(places[i].data());
  return once;
}

}  // namespace

PlaneFitter::PlaneFitter(const PointMatrix& points, float radius)
    : radius_(radius),
      point_count_(points.rows()),
      voxels_(group_by_voxel(points, radius * kMergePerRadius)),
      centroids_(voxels_.centroids(points)),
      grid_(centroids_, radius),
      weights_(weights_of(voxels_, grid_)) {}

Plane PlaneFitter::fit(std::size_t voxel, int min_neighbours) const {
  const Eigen::Vector3f center = centroids_.row(static_cast<Eigen::Index>(voxel));
  std::vector<GridRun> around;
  grid_.find_runs(center, center, radius_, around);
  return fit(voxel, around, min_neighbours);
}

Plane PlaneFitter::fit(std::size_t voxel, const std::vector<GridRun>& around,
                       int min_neighbours) const {
  const Eigen::Vector3f center = centroids_.row(static_cast<Eigen::Index>(voxel));
  const PlaneMoments moments = plane_moments({grid_.x(), grid_.y(), grid_.z(), weights_.data()},
                                             around.data(), around.size(), center.data(), radius_);
  return plane_of(moments, radius_, min_neighbours);
}

PointMatrix PlaneFitter::normals(int min_neighbours) const {
  PointMatrix normals = PointMatrix::Zero(point_count_, 3);
  // Voxels side by side share one look into the grid: it would cost more than the sums.
  const std::vector<GridRun> pieces = grid_.pieces(radius_);
  graph::parallel_for(pieces.size(), 16, [&](std::size_t p) {
    thread_local std::vector<GridRun> around;
    Eigen::AlignedBox3f box;
    for (std::uint32_t i = pieces[p].begin; i < pieces[p].end; ++i)
      box.extend(centroids_.row(grid_.indices()[i]).transpose());
    grid_.find_runs(box.min(), box.max(), radius_, around);
    for (std::uint32_t i = pieces[p].begin; i < pieces[p].end; ++i) {
      const std::uint32_t voxel = grid_.indices()[i];
      const Eigen::Vector3f normal = fit(voxel, around, min_neighbours).normal;
      for (const std::uint32_t point : voxels_[voxel]) normals.row(point) = normal;
    }
  });
  return normals;
}

std::optional<PlaneFitter> suitable_planes(const PointMatrix& points, float smallest,
                                           float spacings) {
  const float spacing = point_spacing(points);
  if (!(spacing > 0)) return std::nullopt;
  const float start = std::max(smallest, spacings * spacing);
  std::optional<PlaneFitter> planes;
  const float radius = suitable_radius(start, [&](float tried) {
    planes.emplace(points, tried);
    return typical_thickness(planes->size(),
                             [&](std::size_t v, int least) { return planes->fit(v, least); });
  });
  if (!planes || planes->radius() != radius) planes.emplace(points, radius);
  return planes;
}

float point_spacing(const PointMatrix& points) {
  std::vector<Place> sample = places_of(points, kSample);
  // A place that holds thousands of points must not make the sample; few scans have one.
  PointMatrix once;
  if (!seem_distinct(sample)) {
    once = distinct(points);
    sample = places_of(once, kSample);
  }
  const PointMatrix& places = once.rows() > 0 ? once : points;
  std::vector<Eigen::Vector3f> chosen;
  chosen.reserve(sample.size());
  for (const Place& place : sample) chosen.emplace_back(Eigen::Vector3f::Map(place.data()));
  if (chosen.size() < 2) return 0;
  // A cell that would hold one point if they filled the largest side of the box around most: far
  // outliers must not set it.
  const float diagonal = middle_diagonal(chosen);
  const float cell = diagonal / std::sqrt(static_cast<float>(places.rows()));
  const PointGrid grid(places, cell);
  const auto nearest_to = [&](const Eigen::Vector3f& point) {
    float nearest = std::numeric_limits<float>::infinity();
    for (float reach = cell; nearest > reach * reach && reach < 4 * diagonal; reach *= 2)
      grid.for_each_within(point, reach, [&nearest](std::uint32_t, float squared) {
        if (squared > 0) nearest = std::min(nearest, squared);
      });
    return std::sqrt(nearest);
  };
  std::vector<float> distances(chosen.size());
  graph::parallel_for(chosen.size(), 32,
                      [&](std::size_t i) { distances[i] = nearest_to(chosen[i]); });
  std::erase_if(distances, [](float distance) { return !std::isfinite(distance); });
  return upper_median(std::move(distances));
}

}  // namespace posevote::geometry
