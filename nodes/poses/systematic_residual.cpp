// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/systematic_residual.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/strewn.hpp"
#include "nodes/poses/patches.hpp"
#include "nodes/poses/scan_rows.hpp"

namespace posevote::poses {
namespace {

constexpr std::size_t kGrain = 256;  // points, which take their time

/// Of the tolerance: beyond an end of the surface a point is something else's.
constexpr float kBeside = 0.6F;

/// Of the model's surface, patches that lie off alike; of its diagonal, how wide they are at least,
/// so that a wire's are not too many.
constexpr float kPatch = 0.005F, kWidth = 0.025F;

/// A scan's point before the model's.
struct Before {
  Eigen::Index row = 0;  // of the model
  double distance = 0;
};

/// None where the scan's point is not before the side of the model that the sensor sees, or turned
/// otherwise.
std::optional<Before> find_before(const Sought& sought, const Eigen::Isometry3f& T_model_scene,
                                  Eigen::Index row) {
  const Cloud& model = sought.model.cloud;
  const float tolerance = sought.params.tolerance;
  const Eigen::Vector3f place = T_model_scene * sought.scan.cloud.points.row(row).transpose();
  const geometry::NearestPoint nearest =
      sought.model_index->nearest.nearest(place, kFarOff * tolerance);
  if (!nearest) return std::nullopt;
  const auto i = static_cast<Eigen::Index>(nearest.index);
  const Eigen::Vector3f at = model.points.row(i).transpose();
  const Eigen::Vector3f normal = model.normals.row(i).transpose();
  const Eigen::Vector3f seen =
      T_model_scene.linear() * sought.scan.cloud.normals.row(row).transpose();
  const float distance = normal.dot(place - at);
  const bool is_beside = (place - at - distance * normal).norm() > kBeside * tolerance;
  if (is_beside || normal.dot(T_model_scene * sought.scan.surface.viewpoint() - at) <= 0 ||
      normal.dot(seen) < static_cast<float>(sought.terms.surface.least_normal_cosine))
    return std::nullopt;
  return Before{i, static_cast<double>(distance)};
}

float side_of_patch(const Model& model) {
  const auto points = static_cast<float>(model.cloud.points.rows());
  return std::max(model.resolution * std::sqrt(kPatch * points), kWidth * model.diagonal);
}

}  // namespace

double systematic_residual(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                           Eigen::Index points) {
  const std::vector<Eigen::Index> rows =
      rows_near(sought, posed_center(T_scene_model, sought.model.center),
                sought.reach + static_cast<double>(kFarOff * sought.params.tolerance));
  const geometry::Strewn some(static_cast<Eigen::Index>(rows.size()), points);
  const Eigen::Isometry3f T_model_scene = T_scene_model.inverse().cast<float>();
  std::vector<std::optional<Before>> all(some.size());
  graph::parallel_for(all.size(), kGrain, [&](std::size_t k) {
    all[k] = find_before(sought, T_model_scene, rows[static_cast<std::size_t>(some[k])]);
  });
  std::erase(all, std::nullopt);
  Eigen::Matrix3Xf places(3, static_cast<Eigen::Index>(all.size()));
  Eigen::VectorXd distances(places.cols());
  for (Eigen::Index k = 0; k < places.cols(); ++k) {
    const Before& one = *all[static_cast<std::size_t>(k)];
    places.col(k) = sought.model.cloud.points.row(one.row).transpose();
    distances[k] = one.distance;
  }
  return shared_deviation(places, distances, side_of_patch(sought.model));
}

}  // namespace posevote::poses
