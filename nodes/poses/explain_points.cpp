// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/explain_points.hpp"

#include "graph/parallel.hpp"

namespace posevote::poses {
namespace {

/// An object's points lie side by side in a scan: few enough for many threads to share them.
constexpr std::size_t kGrain = 256;

/// Most scan points lie far from the object and need no search.
struct Ball {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  float squared_radius = -1;  // holds nothing
};

Ball enclosing_ball(const PointMatrix& points, float margin) {
  if (points.rows() == 0) return {};
  const Eigen::RowVector3f low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  const float radius = 0.5F * (high - low).norm() + 1.01F * margin;
  return {0.5F * (low + high).transpose(), radius * radius};
}

}  // namespace

std::vector<char> explain_points(const Cloud& model, const geometry::SurfaceIndex& model_index,
                                 const Eigen::Isometry3d& T_scene_model, const PointMatrix& points,
                                 const PointMatrix& normals, float distance) {
  const Eigen::Isometry3f T_model_scene = T_scene_model.inverse().cast<float>();
  const Ball ball = enclosing_ball(model.points, distance);
  const Eigen::Vector3f center = T_scene_model.cast<float>() * ball.center;
  std::vector<char> explained(static_cast<std::size_t>(points.rows()), 0);
  graph::parallel_ranges(explained.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    geometry::NearSurface surface(model, model_index);
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (!((points.row(row).transpose() - center).squaredNorm() <= ball.squared_radius)) continue;
      const Eigen::Vector3f point = T_model_scene * Eigen::Vector3f(points.row(row).transpose());
      const Eigen::Vector3f normal =
          T_model_scene.linear() * Eigen::Vector3f(normals.row(row).transpose());
      // Any model point of the right side will do: of a thin wall the wrong side may be the nearer
      // one.
      explained[i] = static_cast<char>(
          surface.is_near(point, normal, distance, [](float cosine) { return cosine > 0; }));
    }
  });
  return explained;
}

}  // namespace posevote::poses
