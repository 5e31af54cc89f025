// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/data/model.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

using namespace posevote;
using namespace posevote::test;

TEST_CASE("find_outline sees where a plate ends, and that a closed body does not", "[match]") {
  const Cloud plate = detail::wall(1, 0.05F), body = bumpy_cloud(1, kResolution);
  const Scale scale{kResolution};
  const auto share = [](const Outline& outline) {
    const auto some = std::count_if(outline.ends.begin(), outline.ends.end(),
                                    [](std::uint8_t ends) { return ends != 0; });
    return static_cast<double>(some) / static_cast<double>(outline.ends.size());
  };
  const Outline edge = run_node<Outline>("find_outline", {}, plate, scale);
  CHECK(edge.reach == 5 * kResolution);
  CHECK(static_cast<Eigen::Index>(edge.ends.size()) == plate.points.rows());
  CHECK(share(edge) > 0.2);
  CHECK(share(edge) < 0.6);
  CHECK(share(run_node<Outline>("find_outline", {}, body, scale)) < 0.1);
  CHECK(share(run_node<Outline>("find_outline", {{"reach", "2"}}, plate, scale)) < share(edge));
  Cloud bare = plate;
  bare.normals.resize(0, 3);
  CHECK_THROWS_WITH(run_node<Outline>("find_outline", {}, bare, scale),
                    Catch::Contains("no normals"));
}
