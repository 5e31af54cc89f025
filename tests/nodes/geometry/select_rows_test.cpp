// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/select_rows.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace posevote::select_rows_test {

TEST_CASE("rows of a scan or a mesh go with their normals, without faces", "[geometry]") {
  Scan scan;
  scan.points.setRandom(5, 3);
  scan.view.origin = {1, 2, 3};
  scan.faces.setZero(1, 3);
  const std::vector<int> rows{4, 0, 4};
  const Scan bare = geometry::select_rows(scan, rows);
  CHECK(bare.points == scan.points(rows, Eigen::all));
  CHECK(bare.normals.rows() == 0);
  CHECK(bare.faces.rows() == 0);
  CHECK(bare.view.origin == scan.view.origin);
  scan.normals = -scan.points;
  CHECK(geometry::select_rows(scan, rows).normals == -bare.points);
  const Mesh mesh = geometry::select_rows(static_cast<const Mesh&>(scan), Eigen::seq(1, 2));
  CHECK(mesh.points == scan.points.middleRows(1, 2));
  CHECK(mesh.normals == scan.normals.middleRows(1, 2));
}

}  // namespace posevote::select_rows_test
