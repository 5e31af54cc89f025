// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/raw_mesh.hpp"

#include "tests/nodes/formats/support.hpp"

namespace posevote::raw_mesh_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("Scan from a mesh: lengths scale, normals do not", "[load]") {
  formats::RawMesh mesh;
  mesh.points = {{1000, 2000, -3000}};
  mesh.normals = {{0, 0, -7}};
  mesh.viewpoint = {500, 0, 0};
  const Scan scan = formats::to_scan(mesh, 0.001);
  CHECK(scan.points.row(0).isApprox(Eigen::RowVector3f(1, 2, -3)));
  CHECK(scan.normals.row(0) == Eigen::RowVector3f(0, 0, -1));
  CHECK(scan.view.origin == Eigen::Vector3f(0.5F, 0, 0));
}

TEST_CASE("Scan from a mesh: points that are not finite go, with their faces", "[load]") {
  formats::RawMesh mesh;
  mesh.points = {{kNan, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, -HUGE_VAL, 0}, {4, 0, 0}, {1e300, 0, 0}};
  mesh.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  mesh.faces = {{0, 1, 2}, {1, 2, 4}, {4, 3, 1}, {1, 2, 5}};
  const Scan scan = formats::to_scan(mesh, 1);
  REQUIRE(scan.points.rows() == 3);
  CHECK(scan.points.col(0) == Eigen::Vector3f(1, 2, 4));
  CHECK(scan.normals.row(2) == Eigen::RowVector3f(-1, 0, 0));
  REQUIRE(scan.faces.rows() == 1);
  CHECK(scan.faces.row(0) == Eigen::Matrix<std::uint32_t, 1, 3>(0, 1, 2));
}

TEST_CASE("Scan from a mesh: normals without a direction are zero", "[load]") {
  formats::RawMesh mesh;
  mesh.points.assign(6, {1, 2, 3});
  mesh.normals = {{0, 0, 0},     {kNan, 0, 1},    {HUGE_VAL, 0, 0},
                  {1e-15, 0, 0}, {3e-8, 4e-8, 0}, {0, 1e6, 0}};
  const Scan scan = formats::to_scan(mesh, 0.001);
  CHECK(scan.normals.topRows(4).isZero(0));
  CHECK(scan.normals.row(4).isApprox(Eigen::RowVector3f(0.6F, 0.8F, 0)));
  CHECK(scan.normals.row(5) == Eigen::RowVector3f(0, 1, 0));
}

TEST_CASE("Scan from a mesh: nothing left is an error", "[load]") {
  formats::RawMesh mesh;
  CHECK_THAT(error_of([&] { formats::to_scan(mesh, 1); }), has("no points"));
  mesh.points.assign(1000, {0, kNan, 0});
  CHECK(error_of([&] { formats::to_scan(mesh, 1); }) == "all 1000 points are NaN or infinite");
  mesh.points[7] = {0, 0, 0};
  CHECK(formats::to_scan(mesh, 1).points.rows() == 1);
  mesh.viewpoint = {0, 0, kNan};
  CHECK_THAT(error_of([&] { formats::to_scan(mesh, 1); }), has("viewpoint"));
}

}  // namespace posevote::raw_mesh_test
