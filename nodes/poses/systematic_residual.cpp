// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/systematic_residual.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/strewn.hpp"
#include "nodes/poses/patches.hpp"
#include "nodes/poses/scan_points.hpp"

namespace posevote::poses {
namespace {

/// Of the tolerance: beyond an end of the surface a point is something else's.
constexpr float kBeside = 0.6F;

/// Of the model's surface, patches that lie off alike; of its diagonal, how wide they are at least,
/// so that a wire's are not too many.
constexpr float kPatch = 0.005F, kWidth = 0.025F;

/// As find_on_model, where it is on a side that is turned to the `eye`, in the model's frame, as that
/// is turned itself.
std::optional<OnModel> find_on_side(const Sought& sought, const Eigen::Isometry3f& T_model_scene,
                                    const Eigen::Vector3f& eye, Eigen::Index row) {
  const float tolerance = sought.params.tolerance;
  const std::optional<OnModel> on = find_on_model(sought, T_model_scene, row, kFarOff * tolerance);
  if (!on || !on->normals_agree) return std::nullopt;
  const Eigen::Vector3f at = sought.model.cloud.points.row(on->row).transpose();
  const Eigen::Vector3f normal = sought.model.cloud.normals.row(on->row).transpose();
  const bool is_beside = (on->away - on->height * normal).norm() > kBeside * tolerance;
  return is_beside || normal.dot(eye - at) <= 0 ? std::nullopt : on;
}

float side_of_patch(const Model& model) {
  const auto points = static_cast<float>(model.cloud.points.rows());
  return std::max(model.resolution * std::sqrt(kPatch * points), kWidth * model.diagonal);
}

}  // namespace

Shared systematic_residual(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                           Eigen::Index points) {
  const std::vector<Eigen::Index> rows =
      rows_near(sought, posed_center(T_scene_model, sought.model.center),
                sought.reach + static_cast<double>(kFarOff * sought.params.tolerance));
  const geometry::Strewn some(static_cast<Eigen::Index>(rows.size()), points);
  const Eigen::Isometry3f T_model_scene = T_scene_model.inverse().cast<float>();
  const Eigen::Vector3f eye = T_model_scene * sought.scan.surface.viewpoint();
  std::vector<std::optional<OnModel>> all(some.size());
  graph::parallel_for(all.size(), kPointsGrain, [&](std::size_t k) {
    all[k] = find_on_side(sought, T_model_scene, eye, rows[static_cast<std::size_t>(some[k])]);
  });
  std::erase_if(all, [](const std::optional<OnModel>& one) { return !one; });
  Eigen::Matrix3Xf places(3, static_cast<Eigen::Index>(all.size()));
  Eigen::VectorXd heights(places.cols());
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    const OnModel& one = *all[static_cast<std::size_t>(k)];
    places.col(k) = sought.model.cloud.points.row(one.row).transpose();
    heights[k] = static_cast<double>(one.height);
  }
  return shared_deviation(places, heights, side_of_patch(sought.model));
}

}  // namespace posevote::poses
