// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/twist.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace posevote::twist_test {

TEST_CASE("a motion and its twist belong together", "[geometry]") {
  for (const double angle : {0.0, 1e-12, 1e-5, 0.3, 3.0, M_PI - 1e-9}) {
    geometry::Vector6d twist;
    twist << 0.4, -0.1, 2, angle * Eigen::Vector3d(1, -2, 2) / 3;
    const Eigen::Isometry3d motion = geometry::exp_motion(twist);
    CHECK((geometry::log_motion(motion) - twist).norm() < 1e-6);
    CHECK((motion.linear() * motion.linear().transpose()).isIdentity(1e-12));
  }
}

TEST_CASE("the turn comes last, and shifts what is off the origin", "[geometry]") {
  // Half a turn about the z axis through (1, 0, 0).
  Eigen::Isometry3d half = Eigen::Isometry3d::Identity();
  half.linear().diagonal() << -1, -1, 1;
  half.translation() << 2, 0, 0;
  const geometry::Vector6d twist = geometry::log_motion(half);
  CHECK(twist.segment<2>(3).norm() == Approx(0).margin(1e-12));
  CHECK(std::abs(twist[5]) == Approx(M_PI));
  // Each point moves by turn x point + shift: not at all on the axis.
  const Eigen::Vector3d shift = twist.head<3>(), turn = twist.tail<3>();
  CHECK((turn.cross(Eigen::Vector3d::UnitX()) + shift).norm() == Approx(0).margin(1e-12));
}

}  // namespace posevote::twist_test
