// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/twist.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace posevote;

TEST_CASE("a motion and its twist belong together", "[geometry]") {
  for (const double angle : {0.0, 1e-12, 1e-5, 0.3, 3.0, M_PI - 1e-9}) {
    geometry::Vector6d twist;
    twist << angle * Eigen::Vector3d(1, -2, 2) / 3, 0.4, -0.1, 2;
    const Eigen::Isometry3d motion = geometry::exp_motion(twist);
    CHECK((geometry::log_motion(motion) - twist).norm() < 1e-6);
    CHECK((motion.linear() * motion.linear().transpose()).isIdentity(1e-12));
  }
}

TEST_CASE("the turn comes first, and shifts what is off the origin", "[geometry]") {
  // Half a turn about the z axis through (1, 0, 0).
  Eigen::Isometry3d half = Eigen::Isometry3d::Identity();
  half.linear().diagonal() << -1, -1, 1;
  half.translation() << 2, 0, 0;
  const geometry::Vector6d twist = geometry::log_motion(half);
  CHECK(twist.head<2>().norm() == Approx(0).margin(1e-12));
  CHECK(std::abs(twist[2]) == Approx(M_PI));
  // Each point moves by turn x point + shift: not at all on the axis.
  const Eigen::Vector3d turn = twist.head<3>(), shift = twist.tail<3>();
  CHECK((turn.cross(Eigen::Vector3d::UnitX()) + shift).norm() == Approx(0).margin(1e-12));
}
