// SPDX-License-Identifier: BSD-3-Clause
// Meshes as CAD programs make them: few and large faces, slivers, walls inside, sheets.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <tuple>

#include "nodes/data/features.hpp"
#include "nodes/formats/read_scan.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::sample_surface_mesh_test {

using Catch::Matchers::Contains;

namespace {

using Params = std::map<std::string, std::string>;
const Scale kScale{0.002F};
constexpr double kSpacing = 0.3 * 0.002;  // [m]

Cloud sampled(const Mesh& model, const Params& params = {}) {
  return test::run_node<Cloud>("sample_surface", params, model, kScale);
}

/// A rectangle from `corner` along two edges, its normal along u x v.
Mesh sheet(const Eigen::RowVector3f& corner, const Eigen::RowVector3f& u,
           const Eigen::RowVector3f& v) {
  Mesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << corner, corner + u, corner + u + v, corner + v;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  return mesh;
}

/// Share of the points on a box around 0 whose normal is that of the side they lie on.
double share_right(const Cloud& cloud, float edge) {
  Eigen::Index right = 0;
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    Eigen::Index axis = 0;
    const float most = cloud.points.row(i).cwiseAbs().maxCoeff(&axis);
    if (std::abs(most - edge / 2) > 1e-6F) return 0;
    right += cloud.normals(i, axis) * cloud.points(i, axis) > 0.999F * most;
  }
  return static_cast<double>(right) / static_cast<double>(cloud.points.rows());
}

/// Least and most points in the squares of edge `cell` [m] of a plane z = height.
std::pair<int, int> density(const Cloud& cloud, float height, float edge, float cell) {
  const int count = static_cast<int>(edge / cell + 0.5F);
  std::vector<int> squares(static_cast<std::size_t>(count * count), 0);
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    if (std::abs(cloud.points(i, 2) - height) > 1e-6F) continue;
    const auto at = [&](int axis) {
      return std::clamp(static_cast<int>((cloud.points(i, axis) + edge / 2) / cell), 0, count - 1);
    };
    ++squares[static_cast<std::size_t>(at(0) * count + at(1))];
  }
  const auto [least, most] = std::minmax_element(squares.begin(), squares.end());
  return {*least, *most};
}

Eigen::Index count_along(const Cloud& cloud, int axis, float sign) {
  return (cloud.normals.col(axis).array() * sign > 0.9F).count();
}

}  // namespace

TEST_CASE("a cube of twelve triangles is sampled evenly on all sides", "[train]") {
  const Cloud cube = sampled(test::box({0, 0, 0}, 0.1F));
  const double expected = 6 * 0.1 * 0.1 / (kSpacing * kSpacing);
  CHECK(static_cast<double>(cube.points.rows()) == Approx(expected).margin(1));
  CHECK(share_right(cube, 0.1F) == 1);
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0F, 1.0F})
      CHECK(static_cast<double>(count_along(cube, axis, sign)) == Approx(expected / 6).margin(2));
  // A voxel of the run gets 11 points on the mean.
  const auto [least, most] = density(cube, 0.05F, 0.1F, kScale.resolution);
  CHECK(least >= 6);
  CHECK(most <= 17);
}

TEST_CASE("slivers are sampled as evenly as anything else", "[train]") {
  // A square of 400 triangles 100 mm long and 0.5 mm wide, as a fan from a corner has them.
  Mesh fan;
  constexpr int kCount = 200;
  fan.points.resize(2 * kCount + 2, 3);
  fan.faces.resize(2 * kCount, 3);
  for (int i = 0; i <= kCount; ++i) {
    const float y = 0.1F * static_cast<float>(i) / kCount - 0.05F;
    fan.points.row(2 * i) << -0.05F, y, 0;
    fan.points.row(2 * i + 1) << 0.05F, y, 0;
  }
  for (std::uint32_t i = 0; i < kCount; ++i) {
    fan.faces.row(2 * i) << 2 * i, 2 * i + 1, 2 * i + 3;
    fan.faces.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 2;
  }
  const Cloud cloud = sampled(fan, {{"two_sided", "never"}});
  CHECK(static_cast<double>(cloud.points.rows()) == Approx(0.01 / (kSpacing * kSpacing)).margin(1));
  const auto [least, most] = density(cloud, 0, 0.1F, kScale.resolution);
  CHECK(least >= 4);
  CHECK(most <= 20);
}

TEST_CASE("samples are the same for mixed, doubled and degenerate faces", "[train]") {
  Mesh mesh = test::box({0, 0, 0}, 0.1F);
  const Cloud clean = sampled(mesh);
  for (const int f : {1, 3, 4, 7, 10}) std::swap(mesh.faces(f, 1), mesh.faces(f, 2));
  mesh.faces.conservativeResize(16, 3);
  mesh.faces.row(12) << 0, 0, 1;
  mesh.faces.row(13) = mesh.faces.row(0);
  mesh.faces.row(14) << mesh.faces(5, 0), mesh.faces(5, 2), mesh.faces(5, 1);  // its back
  mesh.faces.row(15) = mesh.faces.row(2);
  const Cloud mended = sampled(mesh);
  CHECK(mended.points.rows() == clean.points.rows());
  CHECK(share_right(mended, 0.1F) == 1);
}

TEST_CASE("a body that is not connected is turned outward by what can be seen", "[train]") {
  // Six sheets that meet at their edges within rounding, as tessellators leave them, some inward.
  Mesh body;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0F, 1.0F}) {
      Eigen::RowVector3f u = Eigen::RowVector3f::Zero(), v = u, corner = u;
      u((axis + 1) % 3) = v((axis + 2) % 3) = 0.1F;
      corner.setConstant(-0.05F - 1e-7F * static_cast<float>(axis));
      corner(axis) = 0.05F * sign;
      const Mesh side = sheet(corner, u, v);
      body = body.points.rows() == 0 ? side : test::joined(body, side);
    }
  CHECK(share_right(sampled(body), 0.1F) > 0.999);
}

TEST_CASE("what lies within a body is left out", "[train]") {
  const Mesh shell = test::box({0, 0, 0}, 0.1F);
  const Mesh within = test::joined(test::joined(shell, test::box({0.01F, 0, 0}, 0.05F, true)),
                                   sheet({-0.05F, -0.05F, 0.03F}, {0.1F, 0, 0}, {0, 0.1F, 0}));
  const Cloud cloud = sampled(within);
  CHECK(share_right(cloud, 0.1F) > 0.9999);  // all but those at its rim
  CHECK(static_cast<double>(cloud.points.rows()) ==
        Approx(static_cast<double>(sampled(shell).points.rows())).epsilon(0.01));
  CHECK(sampled(within, {{"hidden", "true"}}).points.rows() > cloud.points.rows() * 5 / 4);
  // Two solids that touch: the wall between them, there twice, is gone.
  const Cloud pair = sampled(test::joined(shell, test::box({0.1F, 0, 0}, 0.1F)));
  const auto across = pair.points.rightCols(2).cwiseAbs().rowwise().maxCoeff().array();
  CHECK(((pair.points.col(0).array() - 0.05F).abs() < 1e-5F && across < 0.049F).count() == 0);
  CHECK(static_cast<double>(pair.points.rows()) ==
        Approx(10.0 / 6 * static_cast<double>(sampled(shell).points.rows())).epsilon(0.01));
}

TEST_CASE("a sheet has two sides, a body without its bottom one", "[train]") {
  const Mesh plate = sheet({0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0});
  const Cloud both = sampled(plate), one = sampled(plate, {{"two_sided", "never"}});
  CHECK(both.points.rows() == 2 * one.points.rows());
  CHECK(count_along(both, 2, 1) == count_along(both, 2, -1));
  CHECK(count_along(one, 2, 1) == one.points.rows());  // as the file says
  for (const bool inward : {false, true}) {
    Mesh open = test::box({0, 0, 0}, 0.1F, inward);
    open.faces = FaceMatrix(open.faces.topRows(10));
    const Cloud cloud = sampled(open);
    CHECK(share_right(cloud, 0.1F) == 1);
    CHECK(sampled(open, {{"two_sided", "always"}}).points.rows() == 2 * cloud.points.rows());
  }
}

TEST_CASE("fine meshes of round bodies get round normals, edges stay sharp", "[train]") {
  Mesh can;  // 24 sides, open at both ends
  constexpr std::uint32_t kSides = 24;
  can.points.resize(2 * kSides, 3);
  can.faces.resize(2 * kSides, 3);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    for (std::uint32_t end = 0; end < 2; ++end)
      can.points.row(2 * i + end) << static_cast<float>(0.03 * std::cos(angle)),
          static_cast<float>(0.03 * std::sin(angle)), 0.1F * static_cast<float>(end);
    const std::uint32_t next = (i + 1) % kSides;
    can.faces.row(2 * i) << 2 * i, 2 * next, 2 * next + 1;
    can.faces.row(2 * i + 1) << 2 * i, 2 * next + 1, 2 * i + 1;
  }
  const auto mean_error = [&](const char* crease) {
    const Cloud cloud = sampled(can, {{"crease", crease}, {"two_sided", "never"}});
    PointMatrix radial = cloud.points;
    radial.col(2).setZero();
    radial.rowwise().normalize();
    return test::mean_angle(cloud.normals, radial);
  };
  CHECK(mean_error("0") == Approx(3.75).epsilon(0.05));  // half of half of 15 deg
  CHECK(mean_error("30") < 1.5);
}

TEST_CASE("STL and OBJ as CAD programs write them", "[train][formats]") {
  const test::TemporaryFolder folder;
  const Mesh cube = test::box({0, 0, 0}, 0.1F);
  std::ofstream stl(folder.path() / "cube.stl");
  stl << "solid part\n";
  for (Eigen::Index f = 0; f < 12; ++f) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (int corner = 0; corner < 3; ++corner)
      stl << "vertex " << 1e3F * cube.points.row(cube.faces(f, corner)) << "\n";
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid part\n";
  stl.close();
  std::ofstream obj(folder.path() / "cube.obj");  // six squares, each with its own corners
  obj << "# a CAD program\nmtllib x.mtl\no part\n";
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2;
    obj << "g side" << f << "\nusemtl grey\ns off\n";
    for (const auto& [a, b] : {std::pair(-50, -50), {50, -50}, {50, 50}, {-50, 50}}) {
      Eigen::RowVector3i point;
      point(axis) = f % 2 == 0 ? 50 : -50;
      point((axis + 1) % 3) = a;
      point((axis + 2) % 3) = b;
      obj << "v " << point << "\n";
    }
    obj << "vt 0 0\nvn 0 0 1\nf -4/1/1 -3/-1/-1 -2//1 -1\n";
  }
  obj.close();
  const Cloud expected = sampled(cube);
  for (const char* name : {"cube.stl", "cube.obj"}) {
    INFO(name);
    const Cloud cloud = sampled(formats::read_mesh(folder.path() / name, 1e-3));
    CHECK(share_right(cloud, 0.1F) == 1);
    CHECK(std::abs(cloud.points.rows() - expected.points.rows()) <= 1);
    CHECK(std::abs(count_along(cloud, 1, -1) - count_along(expected, 1, -1)) <= 1);
  }
}

TEST_CASE("huge models are sampled more coarsely, and what has no area is named", "[train]") {
  const Mesh cube = test::box({0, 0, 0}, 10);
  CHECK(sampled(cube, {{"max_points", "5000"}}).points.rows() == 5000);
  Mesh needle = sheet({0, 0, 0}, {1, 0, 0}, {0, 0, 0});
  CHECK_THROWS_WITH(sampled(needle), Contains("faces have no area"));
  needle = cube;
  needle.faces(3, 1) = 9;
  CHECK_THROWS_WITH(sampled(needle), Contains("refers to point 9 of 8"));
}

TEST_CASE("samples are the same each time", "[train]") {
  const Mesh mesh = test::joined(test::box({0, 0, 0}, 0.1F), test::box({0.03F, 0.05F, 0}, 0.1F));
  const Cloud a = sampled(mesh), b = sampled(mesh);
  CHECK(a.points == b.points);
  CHECK(a.normals == b.normals);
}

}  // namespace posevote::sample_surface_mesh_test
