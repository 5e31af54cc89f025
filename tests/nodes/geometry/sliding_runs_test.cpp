// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/sliding_runs.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "tests/support/shapes.hpp"

namespace posevote::sliding_runs_test {

TEST_CASE("runs that slide along a rod hold what is around each of its points", "[prepare]") {
  const PointMatrix points = test::shaken(PointMatrix::Zero(2000, 3), 0.5F);
  const float cell = GENERATE(0.05F, 0.2F);
  const float radius = GENERATE(0.5F, 1.0F, 2.0F) * cell;
  const geometry::PointGrid grid(points, cell);
  geometry::SlidingRuns around(grid, radius);
  std::set<std::size_t> visited;
  for (const geometry::GridRun& piece : grid.pieces(radius))
    around.for_each(piece, [&](std::size_t at, const std::vector<geometry::GridRun>& runs) {
      visited.insert(at);
      const Eigen::Vector3f center(grid.x()[at], grid.y()[at], grid.z()[at]);
      std::set<std::size_t> expected, found;
      grid.for_each_position_within(
          center, radius, [&](std::size_t position, float) { expected.insert(position); });
      std::size_t looks = 0;
      for (const geometry::GridRun& run : runs)
        for (std::size_t i = run.begin; i < run.end; ++i, ++looks)
          if (expected.contains(i)) found.insert(i);
      REQUIRE(found == expected);
      CHECK(looks <= 40 + 60 * expected.size());  // not all that there are
    });
  CHECK(visited.size() == 2000);
}

}  // namespace posevote::sliding_runs_test
