// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/solid.hpp"

#include <algorithm>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/strewn.hpp"

namespace posevote::poses {
namespace {

constexpr Eigen::Index kSolidSample = 500;
constexpr float kBack = 0.7F;  // cosine, of a surface that looks the other way

}  // namespace

Solid::Solid(const Cloud& model, const Eigen::Isometry3d& T_scene_model, float depth)
    : model_(model),
      T_model_scene_(T_scene_model.inverse()),
      depth_(depth),
      box_(geometry::box_around(static_cast<std::size_t>(model.points.rows()),
                                [&model](std::size_t i) -> Eigen::Vector3f {
                                  return model.points.row(static_cast<Eigen::Index>(i)).transpose();
                                })),
      index_(model.points, depth) {}

double Solid::share_inside(const Cloud& other, const Eigen::Isometry3d& T_scene_other) const {
  const Eigen::Isometry3f T = (T_model_scene_ * T_scene_other).cast<float>();
  const geometry::Strewn rows(other.points.rows(), kSolidSample);
  std::vector<char> inside(rows.size());
  graph::parallel_for(inside.size(), 32, [&](std::size_t i) {
    inside[i] =
        static_cast<char>(has_inside(T * Eigen::Vector3f(other.points.row(rows[i]).transpose())));
  });
  if (inside.empty()) return 0;
  const auto count = std::count(inside.begin(), inside.end(), char{1});
  return static_cast<double>(count) / static_cast<double>(inside.size());
}

bool Solid::has_inside(const Eigen::Vector3f& point) const {
  if (!box_.contains(point)) return false;
  const Eigen::Index row = nearest(point);
  const Eigen::RowVector3f outward = model_.points.row(row) - point.transpose();
  return model_.normals.row(row).dot(outward) > depth_ && !is_sheet(row);
}

/// Most points that are asked for lie near the surface: looks there first, then farther.
Eigen::Index Solid::nearest(const Eigen::Vector3f& point) const {
  for (float radius = depth_;; radius *= 2)
    if (const auto found = index_.nearest.nearest(point, radius)) return found.index;
}

bool Solid::is_sheet(Eigen::Index row) const {
  const Eigen::Vector3f point = model_.points.row(row).transpose();
  const auto looks_back = [&](std::uint32_t i, float) {
    return model_.normals.row(row).dot(model_.normals.row(static_cast<Eigen::Index>(i))) < -kBack;
  };
  return index_.grid.find_within(point, depth_, looks_back).has_value();
}

}  // namespace posevote::poses
