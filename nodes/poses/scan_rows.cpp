// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/scan_rows.hpp"

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

}  // namespace posevote::poses
