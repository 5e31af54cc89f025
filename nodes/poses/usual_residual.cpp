// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/usual_residual.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::poses {

void UsualResidual::add(const Fit& fit, double range) {
  const auto weight = static_cast<double>(fit.supported);
  squared_ += weight * fit.rmse * fit.rmse;
  range_ += weight * range;
  weight_ += weight;
}

/// The noise of depth images grows with the square of the distance (Khoshelham, Oude Elberink,
/// Sensors 2012); nearer instances need not be more exact.
double UsualResidual::exactness(const Fit& fit, double range, const Tolerated& tolerated) const {
  if (!(weight_ > 0)) return 1;
  const double farther = range_ > 0 ? std::max(1.0, range * weight_ / range_) : 1;
  const double usual = std::sqrt(squared_ / weight_);
  const double most = std::max(tolerated.residual, tolerated.times * usual * farther * farther);
  if (fit.rmse <= most) return 1;
  return std::max(tolerated.least_exactness, most * most / (fit.rmse * fit.rmse));
}

}  // namespace posevote::poses
