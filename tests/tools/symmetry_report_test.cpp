// SPDX-License-Identifier: BSD-3-Clause
#include "tools/symmetry_report.hpp"

#include <catch2/catch.hpp>

namespace posevote::symmetry_report_test {

TEST_CASE("the symmetries of a model are listed a line each", "[train]") {
  Model model;
  CHECK(symmetry_report(model) == "  no symmetry\n");
  model.symmetries.fixed_point = {0.01F, 0, -0.0021F};
  model.symmetries.axes = {Eigen::Vector3f::UnitZ()};
  model.symmetries.turns.emplace_back(0, 1, 0, 0);
  model.cloud.points.setZero(10, 3);
  NearSymmetry quarter;
  quarter.motion.linear() =
      Eigen::AngleAxisd(std::acos(0), Eigen::Vector3d::UnitY()).toRotationMatrix();
  quarter.carried_off = {1, 2};
  quarter.uncovered = {3, 4};
  model.near_symmetries.items = {quarter};
  CHECK(symmetry_report(model) ==
        "  about the point (10.0 0.0 -2.1) mm:\n"
        "  any turn about (0 0 1)\n"
        "  a turn of 180 deg about (1 0 0)\n"
        "  near: a turn of 90 deg about (0 1 0); 20 % of the surface tells\n");
}

}  // namespace posevote::symmetry_report_test
