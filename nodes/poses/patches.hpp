// SPDX-License-Identifier: BSD-3-Clause
// What residuals are made of. A sensor's noise differs from point to point; where a model is not
// the thing that was scanned, or lies off, whole patches of it lie off alike. A cylinder of the
// clutter under a can of another radius leaves 0.9 mm where the can itself leaves 0.6 mm of noise,
// which is no telling difference; of that 0.5 mm are its patches', against 0.1 mm.
#pragma once

#include <Eigen/Core>

namespace posevote::poses {

/// What the residuals of a patch have in common [as the residuals].
struct Shared {
  double deviation = 0;  ///< one; 0 where noise explains it all
  double doubt = 0;      ///< what noise alone may leave: squared, the standard error of its square
};

/// Estimated without what noise leaves in the means of patches (one-way analysis of variance with
/// random effects; Searle, Casella, McCulloch 1992, section 3.6, about zero). Nothing where no patch
/// has two points. `points`: 3 x n; patches are cubes of this `side`.
Shared shared_deviation(const Eigen::Matrix3Xf& points, const Eigen::VectorXd& residuals,
                        float side);

}  // namespace posevote::poses
