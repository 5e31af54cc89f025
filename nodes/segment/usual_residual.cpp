// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/usual_residual.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::segment {
namespace {

// A model of lower quality than the others leaves more, too: that alone sinks no pose that fits
// well.
constexpr double kLeastExactness = 0.6;

}  // namespace

void UsualResidual::add(const Fit& fit, double range) {
  const auto weight = static_cast<double>(fit.supported);
  squared_ += weight * fit.rmse * fit.rmse;
  range_ += weight * range;
  weight_ += weight;
}

/// The noise of depth images grows with the square of the distance (Khoshelham, Oude Elberink,
/// Sensors 2012); nearer instances need not be more exact.
double UsualResidual::exactness(const Fit& fit, double range, double times, double least) const {
  if (!(weight_ > 0)) return 1;
  const double farther = range_ > 0 ? std::max(1.0, range * weight_ / range_) : 1;
  const double most = std::max(least, times * std::sqrt(squared_ / weight_) * farther * farther);
  if (fit.rmse <= most) return 1;
  return std::max(kLeastExactness, most * most / (fit.rmse * fit.rmse));
}

}  // namespace posevote::segment
