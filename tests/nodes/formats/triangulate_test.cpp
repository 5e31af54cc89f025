// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/triangulate.hpp"

#include <numeric>

#include "nodes/formats/read_scan.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::triangulate_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

using Corners = std::vector<formats::Triple>;

/// The polygon of these corners, of which `first` is the first.
formats::RawMesh polygon(const Corners& corners, std::size_t first = 0) {
  formats::RawMesh mesh;
  mesh.points = corners;
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
  mesh.add_polygon(order);
  return mesh;
}

/// The sum of the triangles' own areas: more than the polygon's where some reach beyond it.
double area(const formats::RawMesh& mesh) {
  double sum = 0;
  for (const auto& face : mesh.faces) {
    Eigen::Vector3d p[3];
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = Eigen::Map<const Eigen::Vector3d>(&mesh.points[face[k]][0]);
    sum += (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
  }
  return sum;
}

const Corners kL{{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};

}  // namespace

TEST_CASE("a concave polygon is cut within itself, whichever corner comes first", "[formats]") {
  for (std::size_t first = 0; first < kL.size(); ++first)
    for (const bool backward : {false, true}) {
      INFO(first << " " << backward);
      Corners corners = kL;
      if (backward) std::reverse(corners.begin(), corners.end());
      formats::RawMesh mesh = polygon(corners, first);
      formats::mend_concave(mesh);
      CHECK(mesh.faces.size() == 4);
      CHECK(area(mesh) == Approx(3));
    }
  formats::RawMesh fan = polygon(kL, 1);
  CHECK(area(fan) == Approx(4));  // what there is to mend
}

TEST_CASE("a concave polygon in any plane, a comb, a ring that is cut open", "[formats]") {
  Corners tilted = kL;
  for (formats::Triple& p : tilted) p = {p[0], p[1], 5 - 2 * p[0] + p[1]};
  formats::RawMesh mesh = polygon(tilted, 1);
  formats::mend_concave(mesh);
  CHECK(area(mesh) == Approx(3 * std::sqrt(6.0)));

  Corners comb{{20, -1, 0}, {0, -1, 0}};
  for (int i = 0; i <= 20; ++i) comb.push_back({double(i), i % 2 ? 5.0 : 0.0, 0});
  mesh = polygon(comb);
  formats::mend_concave(mesh);
  CHECK(mesh.faces.size() == comb.size() - 2);
  CHECK(area(mesh) == Approx(20 + 50));

  mesh = polygon({{0, 0, 0},
                  {4, 0, 0},
                  {4, 4, 0},
                  {0, 4, 0},
                  {0, 0, 0},
                  {1, 1, 0},
                  {1, 3, 0},
                  {3, 3, 0},
                  {3, 1, 0},
                  {1, 1, 0}});
  formats::mend_concave(mesh);
  CHECK(area(mesh) == Approx(16 - 4));
}

TEST_CASE("other polygons stay fans", "[formats]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Corners many;
  for (int i = 0; i < 1200; ++i) many.push_back({double(i), i % 2 ? 1.0 : 0.0, 0});
  for (const Corners& corners :
       {Corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}},           // convex
        Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},             // in line
        Corners{{3, 3, 0}, {0, 3, 0}, {5, 2, 0}, {1, 5, 0}, {5, 3, 0}},  // crosses itself
        Corners{{0, 0, 0}, {2, 0, 0}, {nan, 1, 0}, {1, 1, 0}, {1, 2, 0}}, many}) {
    formats::RawMesh mesh = polygon(corners);
    const auto before = mesh.faces;
    formats::mend_concave(mesh);
    CHECK(mesh.faces == before);
  }
}

TEST_CASE("files with concave polygons, of every format that has polygons", "[formats]") {
  const TempDir dir;
  std::string vertices, v;
  for (const formats::Triple& p : kL)
    for (const std::string prefix : {"", "v "})
      (prefix.empty() ? vertices : v) += prefix + std::to_string(p[0]) + " " +
                                         std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& file : {dir.write("a.obj", "f 2 3 4 5 6 1\n" + v),
                           dir.write("a.off", "OFF\n6 1 0\n" + vertices + "6 1 2 3 4 5 0\n"),
                           dir.write("a.ply", ply + vertices + "6 1 2 3 4 5 0\n")}) {
    INFO(file);
    const Mesh read = formats::read_mesh(file, 1);
    formats::RawMesh mesh;
    mesh.points = kL;
    REQUIRE(read.faces.rows() == 4);
    for (Eigen::Index i = 0; i < 4; ++i)
      mesh.faces.push_back({read.faces(i, 0), read.faces(i, 1), read.faces(i, 2)});
    CHECK(area(mesh) == Approx(3));
  }
}

}  // namespace posevote::triangulate_test
