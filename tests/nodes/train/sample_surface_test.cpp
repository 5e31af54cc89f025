// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <filesystem>

#include "nodes/data/features.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/winding.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::sample_surface_test {

using Catch::Matchers::Contains;

namespace {

const Scale kScale{0.0015F};

/// The vertices, with normals.
Cloud oriented(Mesh model, std::map<std::string, std::string> params = {}) {
  params.emplace("spacing", "0");
  return test::run_node<Cloud>("sample_surface", params, std::move(model), kScale);
}

/// Of the corners of a convex body around `center`, the share whose normal points away from it.
double share_outward(const Cloud& cloud, Eigen::Index begin, Eigen::Index end,
                     const Eigen::RowVector3f& center) {
  int outward = 0;
  for (Eigen::Index i = begin; i < end; ++i)
    outward += cloud.normals.row(i).dot(cloud.points.row(i) - center) > 0 ? 1 : 0;
  return outward / static_cast<double>(end - begin);
}

}  // namespace

TEST_CASE("normals of a model's vertices point outward however the mesh is wound", "[train]") {
  for (const bool inward : {false, true}) {
    const Cloud out = oriented(test::box({1, 2, 3}, 0.1F, inward));
    REQUIRE(out.points.rows() == 8);
    CHECK(share_outward(out, 0, 8, {1, 2, 3}) == 1);
  }
}

TEST_CASE("normals of a model's vertices make inconsistent winding agree", "[train]") {
  Mesh mesh = test::box({0, 0, 0}, 0.1F);
  const Cloud clean = oriented(mesh);
  for (const int f : {0, 3, 4, 7, 10}) std::swap(mesh.faces(f, 0), mesh.faces(f, 2));
  CHECK(test::mean_angle(oriented(mesh).normals, clean.normals) < 0.01);
}

TEST_CASE("normals of a model's vertices are not moved by degenerate and repeated faces",
          "[train]") {
  Mesh mesh = test::box({0, 0, 0}, 0.1F);
  const Cloud clean = oriented(mesh);
  mesh.faces.conservativeResize(17, 3);
  mesh.faces.row(12) << 0, 0, 1;
  mesh.faces.row(13) << 3, 3, 3;
  mesh.faces.row(14) = mesh.faces.row(0);
  mesh.faces.row(15) << mesh.faces(5, 0), mesh.faces(5, 2), mesh.faces(5, 1);  // its back
  mesh.faces.row(16) << mesh.faces(5, 1), mesh.faces(5, 2), mesh.faces(5, 0);
  CHECK(test::mean_angle(oriented(mesh).normals, clean.normals) < 0.01);
}

TEST_CASE("normals of a model's vertices are weighted by area", "[train]") {
  Mesh mesh;  // two faces share an edge along y: one of area 8 facing z, one of area 1 facing x
  mesh.points.resize(4, 3);
  mesh.points << 0, 0, 0, 0, 1, 0, -16, 0, 0, 0, 0, -2;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 3, 1;
  PointMatrix normals = geometry::face_normals(mesh.points, mesh.faces);
  CHECK(normals.row(0).cwiseAbs().isApprox(Eigen::RowVector3f(1, 0, 8).normalized(), 1e-4F));
  CHECK(std::abs(normals(2, 2)) == Approx(1));
}

TEST_CASE("normals of a model's vertices turn each part by itself", "[train]") {
  const Mesh parts = test::joined(test::box({0, 0, 0}, 0.1F), test::box({1, 0, 0}, 0.05F, true));
  const Cloud out = oriented(parts);
  CHECK(share_outward(out, 0, 8, {0, 0, 0}) == 1);
  CHECK(share_outward(out, 8, 16, {1, 0, 0}) == 1);
}

TEST_CASE("normals of a model's vertices keep a cavity's wall facing into the cavity", "[train]") {
  for (const bool inward : {false, true}) {
    const Mesh hollow =
        test::joined(test::box({0, 0, 0}, 0.1F, inward), test::box({0, 0, 0}, 0.09F, !inward));
    const Cloud out = oriented(hollow);
    CHECK(share_outward(out, 0, 8, {0, 0, 0}) == 1);
    CHECK(share_outward(out, 8, 16, {0, 0, 0}) == 0);
  }
}

TEST_CASE("normals of a model's vertices see through seams where points are doubled", "[train]") {
  const Mesh box = test::box({0, 0, 0}, 0.1F);
  Mesh soup;  // every face has corners of its own, every other one is turned
  soup.points.resize(36, 3);
  soup.faces.resize(12, 3);
  for (Eigen::Index f = 0; f < 12; ++f)
    for (int corner = 0; corner < 3; ++corner) {
      soup.points.row(3 * f + corner) = box.points.row(box.faces(f, corner));
      soup.faces(f, f % 2 == 0 ? corner : 2 - corner) = static_cast<std::uint32_t>(3 * f + corner);
    }
  CHECK(share_outward(oriented(soup), 0, 36, {0, 0, 0}) == 1);
}

TEST_CASE("normals of a model's vertices of an open shell face out of its bulge", "[train]") {
  Mesh shell = test::box({0, 0, 0}, 0.1F, true);
  shell.faces = FaceMatrix(shell.faces.topRows(10));  // one side is open
  CHECK(share_outward(oriented(shell), 0, 8, {0, 0, 0}) == 1);
}

TEST_CASE("normals of a model's vertices drop points of no face", "[train]") {
  Mesh mesh = test::box({0, 0, 0}, 0.1F);
  mesh.points.conservativeResize(10, 3);
  mesh.points.bottomRows(2).setZero();
  const Cloud out = oriented(mesh);
  CHECK(out.points.rows() == 8);
}

TEST_CASE("normals of a model's vertices of a raw cloud point outward on each part", "[train]") {
  Mesh model;
  model.points.resize(18000, 3);
  model.points << test::sphere(14000, 0.05F),
      test::sphere(4000, 0.03F).rowwise() + Eigen::RowVector3f(1, 1, 0);
  const Cloud out = oriented(model);
  REQUIRE(out.points.rows() == 18000);
  CHECK(share_outward(out, 0, 14000, {0, 0, 0}) == 1);
  CHECK(share_outward(out, 14000, 18000, {1, 1, 0}) == 1);
  CHECK(test::mean_angle(out.normals.topRows(14000), test::sphere(14000, 1)) < 2);
}

TEST_CASE("normals of a model's vertices of a raw hollow cloud face away from the wall",
          "[train]") {
  // An open cup 4 mm thick, round at the rim: a torus-like profile turned about z.
  std::vector<Eigen::RowVector3f> points;
  std::vector<bool> inner;
  for (int a = 0; a < 300; ++a)
    for (int h = 0; h < 60; ++h)
      for (const bool inside : {false, true}) {
        const double angle = 2 * M_PI * a / 300;
        const double radius = inside ? 0.036 : 0.040;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.001 * h);
        inner.push_back(inside);
      }
  const std::size_t walls = points.size();
  for (int a = 0; a < 300; ++a)
    for (int t = 0; t < 7; ++t) {  // half circles close the wall at either end
      const double angle = 2 * M_PI * a / 300;
      const double turn = M_PI * (t + 1) / 8;
      const double radius = 0.038 + 0.002 * std::cos(turn);
      for (const int end : {-1, 1})
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                            (end < 0 ? 0 : 0.059) + end * 0.002 * std::sin(turn));
    }
  Mesh cup;
  cup.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    cup.points.row(static_cast<Eigen::Index>(i)) = points[i];
  const Cloud out = test::run_node<Cloud>("sample_surface", {}, cup, Scale{0.0005F});
  REQUIRE(out.points.rows() == cup.points.rows());
  int wrong = 0;
  for (std::size_t i = 0; i < walls; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const float away = out.normals.row(row).head<2>().dot(out.points.row(row).head<2>());
    wrong += (away > 0) == inner[i] ? 1 : 0;
  }
  CHECK(wrong < static_cast<int>(walls / 100));
}

TEST_CASE("normals of a model's vertices of real models without their faces", "[train]") {
  for (const std::string name :
       {"bunny/bunny.ply", "icbin/models/obj_000001.ply", "uwa/models/chicken.ply"}) {
    const std::filesystem::path file = test::real_data() / name;
    if (!std::filesystem::exists(file)) {
      WARN("skipped: no " << file);
      continue;
    }
    Mesh mesh = formats::read_mesh(file, name[0] == 'b' ? 1 : 1e-3);
    const PointMatrix truth =
        geometry::face_normals(mesh.points, geometry::wind_outward(mesh.points, mesh.faces));
    mesh.faces.resize(0, 3);
    const Cloud out = oriented(mesh);
    REQUIRE(out.points.rows() == mesh.points.rows());
    int wrong = 0;
    for (Eigen::Index i = 0; i < truth.rows(); ++i)
      wrong += out.normals.row(i).dot(truth.row(i)) < 0;
    INFO(name);
    CHECK(wrong < truth.rows() / 50);
  }
}

TEST_CASE("the Bunny's mesh is wound inward and comes out outward", "[train]") {
  const std::filesystem::path file = test::real_data() / "bunny/bunny.ply";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: no " << file);
    return;
  }
  const Mesh mesh = formats::read_mesh(file, 1);
  const Cloud out = oriented(mesh);
  CHECK(mesh.points.rows() - out.points.rows() == 1113);
  Eigen::Index top = 0;
  out.points.col(1).maxCoeff(&top);
  CHECK(out.normals(top, 1) > 0.5F);
}

TEST_CASE("normals of a model's vertices fail by counts and indices", "[train]") {
  Mesh mesh = test::box({0, 0, 0}, 0.1F);
  mesh.faces(0, 0) = 77;
  CHECK_THROWS_WITH(oriented(mesh), Contains("refers to point 77 of 8"));
  mesh.faces.setConstant(1);
  CHECK_THROWS_WITH(oriented(mesh), Contains("none of its 8 points"));
  CHECK_THROWS_WITH(oriented(Mesh{}), Contains("none of its 0 points"));
  CHECK_THROWS_WITH(oriented(Mesh{}, {{"source", "faces"}}), Contains("none of its 0 points"));
}

}  // namespace posevote::sample_surface_test
