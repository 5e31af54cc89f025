// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/sensor_pose.hpp"

#include <limits>

#include "tests/nodes/formats/support.hpp"

namespace posevote::sensor_pose_test {

using namespace posevote::test;

namespace {

Eigen::Isometry3d pose_of(const std::string& text) {
  return formats::sensor_pose(formats::read_pose_numbers(text));
}
std::string pose_error(const std::string& text) {
  return error_of([&] { pose_of(text); });
}

}  // namespace

TEST_CASE("sensor pose: 3, 7 and 16 numbers, however they stand apart", "[formats]") {
  const Eigen::Vector3d place(0.5, -1, 2);
  for (const char* text : {"0.5 -1 2", "[0.5, -1, 2]", "# x y z\n0.5\n-1 # y\n\n+2.0\n", "0.5;-1;2",
                           "0.5 -1 2 0 0 0.7071 0.7071", "0 -1 0 0.5\n1 0 0 -1\n0 0 1 2\n0 0 0 1\n",
                           "[[0, -1, 0, 0.5], [1, 0, 0, -1], [0, 0, 1, 2], [0, 0, 0, 1]]"})
    CHECK(pose_of(text).translation() == place);
  Eigen::Matrix3d quarter;  // around z
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  CHECK(pose_of("0 0 0 0 0 0.7071 0.7071").linear().isApprox(quarter, 1e-6));
  CHECK(pose_of("0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1").linear().isApprox(quarter, 1e-12));
  CHECK(pose_of("1 2 3").linear().isIdentity());
}

TEST_CASE("sensor pose: what it cannot be is said", "[formats]") {
  CHECK_THAT(pose_error("1 2 3 4 5 6"), has("has 6 numbers, expected 3 (x y z), 7"));
  CHECK_THAT(pose_error("# nothing\n"), has("has 0 numbers"));
  CHECK_THAT(pose_error("1 2 nan"), has("number 3 of the sensor's pose is nan"));
  CHECK_THAT(pose_error("1 inf 2"), has("number 2"));
  CHECK_THAT(pose_error("1 2\n3 here"), has("line 2: ") && has("here"));
  CHECK_THAT(pose_error("0 0 0 1 1 0 0"), has("length 1.414, expected 1"));
  CHECK_THAT(pose_error("1 0 0 0 0 1 0 0 0 0 1 0 0.5 -1 2 1"),  // column by column
             has("last row of the matrix is 0.5 -1 2 1, expected 0 0 0 1"));
  CHECK_THAT(pose_error("2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1"), has("are no rotation"));
  CHECK_THAT(pose_error("1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1"), has("mirror"));
}

TEST_CASE("sensor pose: the file beside a scan", "[formats]") {
  CHECK(formats::pose_file_of("scans/part.7.ply") == "scans/part.7.pose");
}

}  // namespace posevote::sensor_pose_test
