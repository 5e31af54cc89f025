// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/rotation.hpp"

#include <catch2/catch.hpp>

namespace posevote::rotation_test {

TEST_CASE("the axis of a motion passes through its point, whatever slides along it", "[geometry]") {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -0.5).normalized(), point(0.3, -0.1, 0.2);
  for (const double angle : {0.1, 1.0, 3.0}) {
    Eigen::Isometry3d motion =
        geometry::turn_about(point, Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)));
    motion.pretranslate(0.7 * axis);
    const Eigen::Vector3d found = geometry::point_on_axis(motion);
    CHECK((found - point).cross(axis).norm() < 1e-9);
    CHECK(std::abs(found.dot(axis)) < 1e-9);  // the nearest to the origin
  }
}

}  // namespace posevote::rotation_test
