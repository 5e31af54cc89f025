// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/data/symmetries.hpp"

namespace posevote::train {

/// Whether a motion in the model's own frame carries it onto itself: as far as anyone can tell, and
/// but for small marks, which a round body may have.
struct IsExact {
  std::function<bool(const Eigen::Isometry3d&motion)> strictly, about;
};

/// The symmetries of a cloud that is evenly sampled: those of `motions` that are exact and what
/// they make together. All turn about the cloud's mean, which each of them leaves where it is. An
/// axis is continuous where the turns about it by angles that no other symmetry has are exact.
/// `same` [rad]: turns that differ by less are one.
Symmetries exact_symmetries(const Cloud& cloud, const std::vector<Eigen::Isometry3d>& motions,
                            double same, const IsExact& is_exact);

}  // namespace posevote::train
