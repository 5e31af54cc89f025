// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/data/model.hpp"
#include "tests/support/box_cloud.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::find_outline_test {

using namespace posevote::test;

TEST_CASE("find_outline sees where a plate ends, and that a closed body does not", "[match]") {
  const Cloud plate = detail::wall(1, 0.05F), body = bumpy_cloud(1, kResolution);
  const Scale scale{kResolution};
  const auto share = [](const Outline& outline) {
    const auto some = std::count_if(outline.ends.begin(), outline.ends.end(),
                                    [](std::uint8_t ends) { return ends != 0; });
    return static_cast<double>(some) / static_cast<double>(outline.ends.size());
  };
  const Outline edge = run_node<Outline>("find_outline", {}, Mesh{}, plate, scale);
  CHECK(edge.reach == 9 * kResolution);
  CHECK(static_cast<Eigen::Index>(edge.ends.size()) == plate.points.rows());
  CHECK(share(edge) > 0.2);
  CHECK(share(edge) < 0.6);
  CHECK(share(run_node<Outline>("find_outline", {{"reach", "5"}}, Mesh{}, body, scale)) < 0.1);
  CHECK(share(run_node<Outline>("find_outline", {{"reach", "2"}}, Mesh{}, plate, scale)) <
        share(edge));
  Cloud bare = plate;
  bare.normals.resize(0, 3);
  CHECK_THROWS_WITH(run_node<Outline>("find_outline", {}, Mesh{}, bare, scale),
                    Catch::Contains("no normals"));
}

TEST_CASE("find_outline sees where a box bends, and that a sheet does not", "[match]") {
  const Scale scale{0.002F};
  const Cloud body = box_cloud({0.1F, 0.08F, 0.06F}, scale.resolution);
  const std::vector<std::uint32_t> bends =
      run_node<Outline>("find_outline", {}, Mesh{}, body, scale).bends;
  REQUIRE(static_cast<Eigen::Index>(bends.size()) == body.points.rows());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < body.points.rows(); ++i) {
    const auto other = static_cast<Eigen::Index>(bends[static_cast<std::size_t>(i)]);
    if (other == i) continue;
    ++count;
    CHECK((body.points.row(other) - body.points.row(i)).norm() < 1.5F * scale.resolution);
    CHECK(std::abs(body.normals.row(other).dot(body.normals.row(i))) < 0.1F);
  }
  constexpr Eigen::Index kBesideEdges = 2 * 4 * (50 + 40 + 30);  // a row on either side of each
  CHECK(count > kBesideEdges * 9 / 10);
  CHECK(count < kBesideEdges * 11 / 10);
  const auto bends_of = [&](const Cloud& cloud, const char* reach) {
    return run_node<Outline>("find_outline", {{"bend_reach", reach}}, Mesh{}, cloud, scale).bends;
  };
  CHECK(bends_of(body, "0").empty());
  std::vector<Eigen::RowVector3f> points, normals;
  for (const float side : {1.F, -1.F})
    add_rectangle(points, normals, {0, 0, side * 0.0005F}, {0.1F, 0, 0}, {0, side * 0.1F, 0},
                  scale.resolution);
  const std::vector<std::uint32_t> sheet = bends_of(geometry::cloud_of(points, normals), "1.5");
  for (std::size_t i = 0; i < sheet.size(); ++i) CHECK(sheet[i] == i);
}

TEST_CASE("find_outline says nothing where a mesh has its border", "[train]") {
  // A box without its bottom: it ends at four upper edges for sure, at the lower ones perhaps.
  Mesh body = box({0, 0, 0}, 0.1F);
  body.faces = FaceMatrix(body.faces.bottomRows(10));
  const Scale scale{0.002F};
  const Cloud surface =
      run_node<Cloud>("sample_surface", {{"spacing", "1"}, {"two_sided", "never"}}, body, scale);
  const auto ends = [&](const char* borders, float z) {
    const Outline outline =
        run_node<Outline>("find_outline", {{"borders", borders}}, body, surface, scale);
    int count = 0;
    for (Eigen::Index i = 0; i < surface.points.rows(); ++i)
      count += std::abs(surface.points(i, 2) - z) < 0.004F &&
               surface.points.row(i).head<2>().cwiseAbs().minCoeff() < 0.03F &&
               outline.ends[static_cast<std::size_t>(i)] != 0;
    return count;
  };
  CHECK(ends("unknown", 0.05F) > 50);
  CHECK(ends("end", 0.05F) == ends("unknown", 0.05F));
  CHECK(ends("end", -0.05F) > 50);
  CHECK(ends("unknown", -0.05F) == 0);
  CHECK_THROWS(run_node<Outline>("find_outline", {{"borders", "no"}}, body, surface, scale));
}

}  // namespace posevote::find_outline_test
