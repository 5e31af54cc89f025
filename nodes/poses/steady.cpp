// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/steady.hpp"

namespace posevote::poses {

/// Motions are small and of the model's frame, so the twist between both poses is the innovation
/// and covariances add.
UncertainPose steady(const UncertainPose& before, const UncertainPose& measured,
                     const SteadyTerms& terms) {
  using geometry::Matrix6d;
  const Matrix6d predicted = before.covariance + terms.drift * measured.covariance;
  const auto both = Matrix6d(predicted + measured.covariance).ldlt();
  const geometry::Vector6d innovation =
      geometry::log_motion(before.T_scene_model.inverse() * measured.T_scene_model);
  if (!(innovation.dot(both.solve(innovation)) <= terms.still)) return measured;
  const Matrix6d gain = both.solve(predicted).transpose();
  const Matrix6d left = (Matrix6d::Identity() - gain) * predicted;
  return {before.T_scene_model * geometry::exp_motion(gain * innovation),
          0.5 * (left + left.transpose())};
}

}  // namespace posevote::poses
