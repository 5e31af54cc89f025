// SPDX-License-Identifier: BSD-3-Clause
// How exactly the instances that were found in a scan lie on it: what sensor and models leave over
// whole patches between them (Fit::systematic). A look-alike, say a smooth body of about the right
// size, supports a wrong pose all over within the tolerance, which has to be wide enough for the
// worst sensor; but patches of it lie off by several times as much. How large that is the scan itself
// says, no parameter.
#pragma once

#include "nodes/poses/measure_fit.hpp"

namespace posevote::poses {

/// What a pose may leave.
struct Tolerated {
  double times = 1;     ///< what the instances before did
  double residual = 0;  ///< and this in any case [m]
};

class UsualResidual {
 public:
  /// Of an instance at a distance of `range` from the sensor [m]. Counts by its support.
  void add(const Fit& fit, double range);
  /// In (0, 1]: what is tolerated over what a pose leaves, which is looked at closely, where that is
  /// more. Both with what is tolerated in any case, so that it is smooth, and what noise alone may
  /// leave in so few points (Fit::systematic_doubt). 1 where nothing was found yet.
  double exactness(const Fit& fit, double range, const Tolerated& tolerated) const;

 private:
  double squared_ = 0, range_ = 0, weight_ = 0;  // weighted sums
};

}  // namespace posevote::poses
