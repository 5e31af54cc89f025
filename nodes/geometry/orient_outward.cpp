// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/orient_outward.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::geometry {
namespace {

/// The best edge, then the smaller indices: the order does not depend on anything else.
struct Step {
  float quality;
  std::uint32_t to;
  std::uint32_t from;

  bool operator<(const Step& other) const {
    return std::tuple(quality, other.to, other.from) < std::tuple(other.quality, to, from);
  }
};

class Traversal {
 public:
  Traversal(PointMatrix points, float radius, PointMatrix& normals)
      : points_(std::move(points)),
        grid_(points_, radius),
        radius_(radius),
        normals_(normals),
        visited_(static_cast<std::size_t>(points_.rows()), 0),
        best_(visited_.size(), -1) {}

  void run() {
    for (std::uint32_t i = 0; i < visited_.size(); ++i)
      if (!visited_[i]) turn_outward(spread(i));
  }

 private:
  Eigen::Vector3f at(std::uint32_t i) const { return points_.row(i); }

  /// Turns the normals of a connected part over where most of its outermost points face inward.
  void turn_outward(const std::vector<std::uint32_t>& part) {
    float outward = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const Eigen::Vector3f direction = Eigen::Vector3i(x, y, z).cast<float>().normalized();
          const std::uint32_t outermost =
              *std::max_element(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
                return at(a).dot(direction) < at(b).dot(direction);
              });
          outward += normals_.row(outermost).dot(direction);
        }
    if (outward >= 0) return;
    for (const std::uint32_t i : part) normals_.row(i) *= -1.0F;
  }

  /// In [0, 1]: how parallel the normals are and how much the edge runs along both planes.
  float quality(std::uint32_t from, std::uint32_t to) const {
    const Eigen::Vector3f a = normals_.row(from);
    const Eigen::Vector3f b = normals_.row(to);
    const float parallel = std::abs(a.dot(b));
    const Eigen::Vector3f edge = at(to) - at(from);
    const float length = edge.norm();
    if (!(length > 0)) return parallel;
    const float across = std::max(std::abs(edge.dot(a)), std::abs(edge.dot(b))) / length;
    return parallel * std::max(0.0F, 1 - across);
  }

  /// Carries the sign of `start` through its connected part; returns the part.
  std::vector<std::uint32_t> spread(std::uint32_t start) {
    std::vector<std::uint32_t> part;
    std::priority_queue<Step> steps;
    steps.push({1, start, start});
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (visited_[step.to]) continue;
      visited_[step.to] = 1;
      part.push_back(step.to);
      if (normals_.row(step.to).dot(normals_.row(step.from)) < 0) normals_.row(step.to) *= -1.0F;
      grid_.for_each_within(at(step.to), radius_, [&](std::uint32_t next, float) {
        if (visited_[next]) return;
        const float edge = quality(step.to, next);
        if (edge <= best_[next]) return;
        best_[next] = edge;
        steps.push({edge, next, step.to});
      });
    }
    return part;
  }

  const PointMatrix points_;
  const PointGrid grid_;
  const float radius_;
  PointMatrix& normals_;
  std::vector<char> visited_;
  std::vector<float> best_;  ///< quality of the best edge to a point so far: only better ones count
};

}  // namespace

void orient_outward(const PointMatrix& points, float radius, PointMatrix& normals) {
  std::vector<Eigen::Index> usable;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (!normals.row(i).isZero()) usable.push_back(i);
  if (usable.empty()) return;
  const PointMatrix usable_points = points(usable, Eigen::all);
  const Voxels voxels = group_by_voxel(usable_points, radius / 5);
  std::vector<Eigen::Index> first;
  for (std::size_t v = 0; v < voxels.size(); ++v) first.push_back(usable[voxels[v].front()]);

  PointMatrix oriented = normals(first, Eigen::all);
  Traversal(points(first, Eigen::all), radius, oriented).run();
  for (std::size_t v = 0; v < voxels.size(); ++v)
    for (const std::uint32_t i : voxels[v]) {
      const Eigen::Index point = usable[i];
      if (normals.row(point).dot(oriented.row(static_cast<Eigen::Index>(v))) < 0)
        normals.row(point) *= -1.0F;
    }
}

}  // namespace posevote::geometry
