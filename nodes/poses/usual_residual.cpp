// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/usual_residual.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::poses {

void UsualResidual::add(const Fit& fit, double range) {
  const auto weight = static_cast<double>(fit.supported);
  squared_ += weight * fit.systematic * fit.systematic;
  range_ += weight * range;
  weight_ += weight;
}

/// The noise of depth images grows with the square of the distance (Khoshelham, Oude Elberink,
/// Sensors 2012); nearer instances need not be more exact.
double UsualResidual::exactness(const Fit& fit, double range, const Tolerated& tolerated) const {
  if (!(weight_ > 0)) return 1;
  const double farther = range_ > 0 ? std::max(1.0, range * weight_ / range_) : 1;
  const double times = tolerated.times * farther * farther;
  const double any_case =
      tolerated.residual * tolerated.residual + fit.systematic_doubt * fit.systematic_doubt;
  const double most = times * times * squared_ / weight_ + any_case;
  const double left = fit.systematic * fit.systematic + any_case;
  return left > most ? std::sqrt(most / left) : 1;
}

}  // namespace posevote::poses
