// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/model_rim.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "graph/parallel.hpp"
#include "nodes/prepare/grid.hpp"

namespace posevote {

ModelRim::ModelRim(const Cloud& model, float reach)
    : model_(model), reach_(reach), ends_(static_cast<std::size_t>(model.points.rows()), 0) {
  const float near = reach / 2;
  const PointGrid grid(model.points, near);
  graph::parallel_for(ends_.size(), 256, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (int k = 0; k < kDirections; ++k) {
      bool goes_on = false;
      grid.for_each_within(ahead(row, k), near, [&](std::uint32_t, float) { goes_on = true; });
      if (!goes_on) ends_[i] = static_cast<std::uint8_t>(ends_[i] | 1U << k);
    }
  });
}

Eigen::Vector3f ModelRim::ahead(Eigen::Index i, int direction) const {
  const Eigen::Vector3f normal = model_.normals.row(i).transpose();
  const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
  const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(direction) / kDirections;
  return model_.points.row(i).transpose() + reach_ * (std::cos(angle) * u + std::sin(angle) * v);
}

}  // namespace posevote
