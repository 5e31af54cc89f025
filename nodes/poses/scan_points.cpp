// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/scan_points.hpp"

namespace posevote::poses {

std::vector<Eigen::Index> rows_near(const Sought& sought, const Eigen::Vector3d& place,
                                    double reach) {
  const Eigen::RowVector3f middle = place.cast<float>().transpose();
  const auto most = static_cast<float>(reach * reach);
  const PointMatrix& points = sought.scan.cloud.points;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if ((points.row(i) - middle).squaredNorm() < most &&
        !sought.scan.surface.is_gone(static_cast<std::size_t>(i)))
      rows.push_back(i);
  return rows;
}

std::optional<OnModel> find_on_model(const Sought& sought, const Eigen::Isometry3f& T_model_scene,
                                     Eigen::Index row, float most) {
  const Cloud& model = sought.model.cloud;
  const Eigen::Vector3f place = T_model_scene * sought.scan.cloud.points.row(row).transpose();
  const geometry::NearestPoint nearest = sought.model_index->nearest.nearest(place, most);
  if (!nearest) return std::nullopt;
  const auto i = static_cast<Eigen::Index>(nearest.index);
  const Eigen::Vector3f away = place - model.points.row(i).transpose();
  const Eigen::Vector3f seen =
      T_model_scene.linear() * sought.scan.cloud.normals.row(row).transpose();
  const auto normal = model.normals.row(i);
  const auto agree = static_cast<float>(sought.terms.surface.least_normal_cosine);
  return OnModel{i, away, normal.dot(away), !(normal.dot(seen) < agree)};
}

}  // namespace posevote::poses
