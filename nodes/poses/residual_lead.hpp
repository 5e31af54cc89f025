// SPDX-License-Identifier: BSD-3-Clause
// What is a hundredth of a surface (the notch of an integrated circuit, a cap, a hole) tells two
// poses apart by the scan's points there: of the right pose they lie on the model's surface, of the
// other off it, by more than noise, if less than any tolerance.
#pragma once

#include <Eigen/Geometry>

#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// How much better the scan's points that nothing explained yet lie on the model's surface posed in
/// one way than in another: in standard deviations, as points err alike (`TwinTerms::err_alike`).
/// Points off whose surfaces they lie hardly more in one pose than in the other do not count, nor
/// those that are near neither.
double residual_lead(const Sought& sought, const Eigen::Isometry3d& one,
                     const Eigen::Isometry3d& other);

}  // namespace posevote::poses
