// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/explain_points.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/support/bumpy_scene.hpp"

namespace posevote::explain_points_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

constexpr float kDistance = 3 * kResolution;

std::vector<char> explain(const Placed& body, const Cloud& scan) {
  const Cloud model = bumpy_model(body.shape)->cloud;
  const geometry::SurfaceIndex index(model.points, kDistance);
  return poses::explain_points(model, index, body.T_scene_model, scan.points, scan.normals,
                               kDistance);
}

}  // namespace

TEST_CASE("a body explains its own points and no others", "[poses]") {
  const Placed body{1, pose(-0.08, 0, 0.8, 0.7)}, other{2, pose(0.08, 0, 0.8, 0.2)};
  const Cloud scan = scan_of({body, other});
  const std::vector<char> explained = explain(body, scan);
  REQUIRE(static_cast<Eigen::Index>(explained.size()) == scan.points.rows());
  int wrong = 0;
  for (std::size_t i = 0; i < explained.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const bool own = scan.points(row, 0) < 0 && scan.points(row, 2) < 1.2F;
    wrong += own != static_cast<bool>(explained[i]);
  }
  CHECK(wrong == 0);
}

TEST_CASE("points whose normals are opposed are not explained", "[poses]") {
  const Placed body{1, pose(0, 0, 0.8, 0.7)};
  Cloud scan = scan_of({body}, false);
  scan.normals *= -1;
  const std::vector<char> explained = explain(body, scan);
  CHECK(std::accumulate(explained.begin(), explained.end(), 0) == 0);
}

TEST_CASE("of a thin wall the far side does not stand before the near one", "[poses]") {
  Cloud sheet;
  sheet.points.resize(2, 3);
  sheet.normals.resize(2, 3);
  sheet.points << 0, 0, 0, 0, 0, 0.001F;
  sheet.normals << 0, 0, -1, 0, 0, 1;
  PointMatrix point(1, 3), normal(1, 3);
  point << 0, 0, 0.002F;
  normal << 0, 0, -1;
  const geometry::SurfaceIndex index(sheet.points, kDistance);
  const auto identity = Eigen::Isometry3d::Identity();
  CHECK(poses::explain_points(sheet, index, identity, point, normal, kDistance).front() == 1);
  CHECK(poses::explain_points(sheet, index, identity, point, normal, 0.0015F).front() == 0);
}

TEST_CASE("points that are not finite are never explained", "[poses]") {
  const Placed body{1, pose(0, 0, 0.8, 0.7)};
  Cloud scan = scan_of({body}, false);
  scan.points.row(0).setConstant(std::nanf(""));
  scan.normals.row(1).setConstant(std::nanf(""));
  const std::vector<char> explained = explain(body, scan);
  CHECK(explained[0] == 0);
  CHECK(explained[1] == 0);
  CHECK(explained[2] == 1);
}

}  // namespace posevote::explain_points_test
