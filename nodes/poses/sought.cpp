// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/sought.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::poses {

double reach_of(const Model& model) {
  constexpr double kTrifle = 1.001;
  float squared = 0;
  for (Eigen::Index i = 0; i < model.cloud.points.rows(); ++i)
    squared =
        std::max(squared, (model.cloud.points.row(i).transpose() - model.center).squaredNorm());
  return kTrifle *
         (std::sqrt(static_cast<double>(squared)) + static_cast<double>(model.outline.reach));
}

}  // namespace posevote::poses
