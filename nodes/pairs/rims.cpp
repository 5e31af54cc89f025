// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/rims.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "graph/parallel.hpp"
#include "nodes/geometry/grid_normals.hpp"
#include "nodes/geometry/sliding_runs.hpp"
#include "nodes/geometry/voxels.hpp"
#include "nodes/pairs/face_sums.hpp"

namespace posevote::pairs {
namespace {

constexpr float kSameFace = 0.87F;  // cosine of 30 deg between normals
constexpr float kFewest = 6;        // neighbours
// x radius.
constexpr float kOffPlane = 0.25F;
constexpr float kHalfDisc = 0.424F;  // how far off the mean of half a disc is: 4 / (3 pi)
constexpr float kLeastOff = 0.25F;   // that of a disc that is cut 0.3 from its centre
constexpr float kComesIn = 0.55F;    // by which the mean comes in as the cut goes out

/// At the grid's `i`-th point. `runs`: of the points within the radius.
std::optional<Rim> rim_at(const geometry::OrientedColumns& all, std::size_t i, float radius,
                          const std::vector<geometry::GridRun>& runs) {
  const Eigen::Vector3f point(all.x[i], all.y[i], all.z[i]);
  const Eigen::Vector3f normal(all.nx[i], all.ny[i], all.nz[i]);
  if (!normal.allFinite() || normal.isZero()) return std::nullopt;
  const FaceSums sums = face_sums(all, runs.data(), runs.size(),
                                  {{point.x(), point.y(), point.z()},
                                   {normal.x(), normal.y(), normal.z()},
                                   radius,
                                   kOffPlane * radius,
                                   kSameFace});
  if (sums.count < kFewest) return std::nullopt;
  const Eigen::Vector3f mean = Eigen::Vector3f(sums.x, sums.y, sums.z) / sums.count;
  const Eigen::Vector3f off = mean - normal.dot(mean) * normal;
  const float share = off.norm() / radius;
  if (!(share > kLeastOff)) return std::nullopt;
  const Eigen::Vector3f direction = -off.normalized();
  const float ahead = std::max(0.0F, (kHalfDisc - share) / kComesIn) * radius;
  return Rim{point + ahead * direction, normal, direction};
}

/// Ends of one cube that are of one face and direction.
struct Side {
  Rim first, sum;
  float count = 1;

  bool has(const Rim& rim) const {
    return first.normal.dot(rim.normal) > kSameFace &&
           first.direction.dot(rim.direction) > kSameFace;
  }
  void add(const Rim& rim) {
    sum.point += rim.point;
    sum.normal += rim.normal;
    sum.direction += rim.direction;
    ++count;
  }
  Rim mean() const {
    const Eigen::Vector3f normal = sum.normal.normalized();
    return {sum.point / count, normal,
            (sum.direction - normal.dot(sum.direction) * normal).normalized()};
  }
};

}  // namespace

std::vector<Rim> find_rims(const Cloud& cloud, float radius) {
  const geometry::PointGrid grid(cloud.points, radius);
  const geometry::GridNormals normals(grid, cloud.normals, [](std::uint32_t) { return true; });
  std::vector<std::optional<Rim>> found(static_cast<std::size_t>(cloud.points.rows()));
  const std::vector<geometry::GridRun> pieces = grid.pieces(radius);
  graph::parallel_ranges(pieces.size(), 32, [&](std::size_t begin, std::size_t end) {
    geometry::SlidingRuns around(grid, radius);
    for (std::size_t p = begin; p < end; ++p)
      around.for_each(pieces[p], [&](std::size_t i, const std::vector<geometry::GridRun>& runs) {
        found[grid.indices()[i]] = rim_at(normals.columns(), i, radius, runs);
      });
  });
  std::vector<Rim> rims;
  for (const auto& one : found)
    if (one) rims.push_back(*one);
  return rims;
}

std::vector<Rim> thin_rims(const std::vector<Rim>& rims, float edge) {
  if (rims.empty()) return {};
  const geometry::Voxels voxels = geometry::group_by_voxel(cloud_of(rims).points, edge);
  std::vector<Rim> thin;
  std::vector<Side> sides;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    sides.clear();
    for (const std::uint32_t i : voxels[v]) {
      const auto same = std::find_if(sides.begin(), sides.end(),
                                     [&](const Side& side) { return side.has(rims[i]); });
      if (same == sides.end())
        sides.push_back({rims[i], rims[i]});
      else
        same->add(rims[i]);
    }
    for (const Side& side : sides) thin.push_back(side.mean());
  }
  return thin;
}

Cloud cloud_of(const std::vector<Rim>& rims) {
  Cloud cloud{PointMatrix(std::ssize(rims), 3), PointMatrix(std::ssize(rims), 3), {}};
  for (std::size_t i = 0; i < rims.size(); ++i) {
    cloud.points.row(static_cast<Eigen::Index>(i)) = rims[i].point.transpose();
    cloud.normals.row(static_cast<Eigen::Index>(i)) = rims[i].direction.transpose();
  }
  return cloud;
}

std::vector<LocalFrame> frames_of(const std::vector<Rim>& rims) {
  std::vector<LocalFrame> frames;
  for (const Rim& rim : rims) frames.emplace_back(rim.point, rim.direction, rim.normal);
  return frames;
}

}  // namespace posevote::pairs
