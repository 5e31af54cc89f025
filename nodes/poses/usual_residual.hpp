// SPDX-License-Identifier: BSD-3-Clause
// How exactly the instances that were found in a scan lie on it: what the noise of sensor and
// models leaves between them. A look-alike, say a smooth body of about the right size, supports a
// wrong pose all over within the tolerance, which has to be wide enough for the worst sensor; but
// it lies off by several times the noise. How large that is the scan itself says, no parameter.
//
// Measured against the best instance of the same scan, on two simulated laser sets and three
// simulated and real RGB-D sets: 99 of 100 true instances stay below 1.63 times, all below 1.91;
// look-alikes among the clutter reach 2 to 4.
#pragma once

#include "nodes/poses/measure_fit.hpp"

namespace posevote::poses {

/// What a pose may leave.
struct Tolerated {
  double times = 1.5;            ///< what the instances before did
  double residual = 0;           ///< and this in any case [m]
  double least_exactness = 0.6;  ///< of a pose that leaves more
};

class UsualResidual {
 public:
  /// Of an instance at a distance of `range` from the sensor [m]. Counts by its support.
  void add(const Fit& fit, double range);
  /// In [least_exactness, 1]: 1 for a pose that leaves no more than is tolerated; falls with the
  /// square of what is more. 1 where nothing was found yet.
  double exactness(const Fit& fit, double range, const Tolerated& tolerated) const;

 private:
  double squared_ = 0, range_ = 0, weight_ = 0;  // weighted sums
};

}  // namespace posevote::poses
