// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace posevote::poses {
namespace {

struct Patch {
  double sum = 0;
  int count = 0;
};

/// Those that have points, in an order that the points alone tell.
std::vector<Patch> patches_of(const Eigen::Matrix3Xf& points, const Eigen::VectorXd& residuals,
                              float side) {
  const Eigen::Vector3f low = points.rowwise().minCoeff();
  const Eigen::Vector3f extent = points.rowwise().maxCoeff() - low;
  const Eigen::Array3i cells = (extent.array() / side).cast<int>() + 1;
  std::vector<Patch> patches(static_cast<std::size_t>(cells.prod()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3i at = ((points.col(i) - low).array() / side).cast<int>();
    Patch& patch =
        patches[static_cast<std::size_t>((at.z() * cells.y() + at.y()) * cells.x() + at.x())];
    patch.sum += residuals[i];
    ++patch.count;
  }
  std::erase_if(patches, [](const Patch& patch) { return patch.count == 0; });
  return patches;
}

}  // namespace

Shared shared_deviation(const Eigen::Matrix3Xf& points, const Eigen::VectorXd& residuals,
                        float side) {
  if (points.cols() == 0) return {};
  const std::vector<Patch> patches = patches_of(points, residuals, side);
  double between = 0;  // sums of squares
  for (const Patch& patch : patches) between += patch.sum * patch.sum / patch.count;
  const auto all = static_cast<double>(points.cols()), few = static_cast<double>(patches.size());
  if (all <= few) return {};
  const double noise = (residuals.squaredNorm() - between) / (all - few);
  // of `between` noise has the variance 2 few noise^2, of few * noise few / (all - few) times that
  const double error = noise * std::sqrt(2 * few / (all * (all - few)));
  return {std::sqrt(std::max(0.0, (between - few * noise) / all)), std::sqrt(error)};
}

}  // namespace posevote::poses
