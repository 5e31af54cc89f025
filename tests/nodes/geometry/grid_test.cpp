// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/grid.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "tests/support/shapes.hpp"

namespace posevote::grid_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

PointMatrix scattered(int count, float edge) {
  return test::shaken(PointMatrix::Zero(count, 3), edge);
}

std::set<std::uint32_t> by_brute_force(const PointMatrix& points, const Eigen::Vector3f& center,
                                       float radius) {
  std::set<std::uint32_t> found;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const float dx = points(i, 0) - center.x();
    const float dy = points(i, 1) - center.y();
    const float dz = points(i, 2) - center.z();
    if (dx * dx + dy * dy + dz * dz <= radius * radius) found.insert(static_cast<std::uint32_t>(i));
  }
  return found;
}

std::vector<std::uint32_t> within(const geometry::PointGrid& grid, const Eigen::Vector3f& center,
                                  float radius) {
  std::vector<std::uint32_t> found;
  grid.for_each_within(center, radius, [&](std::uint32_t i, float) { found.push_back(i); });
  return found;
}

}  // namespace

TEST_CASE("PointGrid finds what brute force finds, once each", "[prepare]") {
  PointMatrix points = scattered(3000, 1);
  for (const float shift : {0.0F, 300.0F}) {  // far away, float rounding decides at the rim
    points.array() += shift;
    for (const float cell : {0.02F, 0.1F, 5.0F}) {
      const geometry::PointGrid grid(points, cell);
      for (Eigen::Index i = 0; i < points.rows(); i += 101)
        for (const float radius : {0.0F, 0.05F, 0.2F, 4.0F, kInfinity}) {
          const std::vector<std::uint32_t> found = within(grid, points.row(i), radius);
          const std::set<std::uint32_t> once(found.begin(), found.end());
          CHECK(once.size() == found.size());
          CHECK(once == by_brute_force(points, points.row(i), radius));
        }
    }
  }
}

TEST_CASE("PointGrid asks of each neighbour until one will do", "[prepare]") {
  const PointMatrix points = scattered(500, 1);
  const geometry::PointGrid grid(points, 0.1F);
  for (const float radius : {0.01F, 0.2F}) {
    const std::vector<std::uint32_t> near = within(grid, points.row(7), radius);
    for (std::uint32_t wanted = 0; wanted < 500; ++wanted) {
      std::size_t asked = 0;
      const auto found =
          grid.find_within(points.row(7), radius, [&](std::uint32_t i, float squared) {
            CHECK(squared <= radius * radius);
            return ++asked, i == wanted;
          });
      CHECK(found.value_or(wanted) == wanted);
      CHECK(found.has_value() == (std::find(near.begin(), near.end(), wanted) != near.end()));
      CHECK((found || asked == near.size()));
    }
  }
  CHECK_FALSE(grid.find_within({kNan, 0, 0}, 1, [](std::uint32_t, float) { return true; }));
}

TEST_CASE("PointGrid includes a neighbour at exactly the radius", "[prepare]") {
  PointMatrix points(4, 3);
  points << 0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0, 0, 0, -0.1F;
  for (const float cell : {0.1F, 0.03F}) {
    CHECK(within(geometry::PointGrid(points, cell), {0, 0, 0}, 0.1F).size() == 4);
    CHECK(within(geometry::PointGrid(points, cell), {0, 0, 0}, 0.0999F).size() == 1);
  }
}

TEST_CASE("PointGrid takes far outliers, twins and points that are not finite", "[prepare]") {
  PointMatrix points = scattered(20000, 1);
  points.row(1) << 1e3F, 0, 0;
  points.row(2) << 0, -1e30F, 1e30F;
  points.row(3) << kNan, 0, 0;
  points.row(4) << 0, kInfinity, 0;
  for (Eigen::Index i = 5; i < 100; ++i) points.row(i).setConstant(0.25F);
  const geometry::PointGrid grid(points, 0.001F);
  CHECK(within(grid, {1e3F, 0, 0}, 0.1F) == std::vector<std::uint32_t>{1});
  CHECK(within(grid, {0.25F, 0.25F, 0.25F}, 0.0001F).size() >= 95);
  CHECK(within(grid, {0, 0, 0}, 10).size() == 19996);
}

TEST_CASE("PointGrid answers senseless questions with nothing", "[prepare]") {
  const PointMatrix points = scattered(50, 1);
  for (const float cell : {0.1F, 0.0F, -1.0F, kNan, kInfinity}) {
    const geometry::PointGrid grid(points, cell);
    CHECK(within(grid, points.row(7), 0.0F).size() == 1);
    CHECK(within(grid, {kNan, 0, 0}, 1).empty());
    CHECK(within(grid, {0, 0, 0}, -1).empty());
    CHECK(within(grid, {0, 0, 0}, kNan).empty());
  }
  CHECK(within(geometry::PointGrid(PointMatrix(0, 3), 1), {0, 0, 0}, 1).empty());
}

TEST_CASE("PointGrid visits in the same order each time", "[prepare]") {
  const PointMatrix points = scattered(5000, 1);
  CHECK(within(geometry::PointGrid(points, 0.1F), {0.1F, 0, 0}, 0.3F) ==
        within(geometry::PointGrid(points, 0.1F), {0.1F, 0, 0}, 0.3F));
}

TEST_CASE("PointGrid's runs hold all that is near a box", "[prepare]") {
  const PointMatrix points = scattered(3000, 1);
  const geometry::PointGrid grid(points, 0.1F);
  const Eigen::Vector3f low(-0.3F, -0.1F, 0), high(0.1F, 0.2F, 0.25F);
  std::vector<geometry::GridRun> runs{{7, 9}};
  grid.find_runs(low, high, 0.1F, runs);
  std::set<std::uint32_t> held;
  for (const geometry::GridRun& run : runs)
    for (std::uint32_t i = run.begin; i < run.end; ++i) {
      CHECK(held.insert(grid.indices()[i]).second);
      CHECK(grid.x()[i] == points(grid.indices()[i], 0));
    }
  int near = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Eigen::Vector3f p = points.row(i);
    if (Eigen::AlignedBox3f(low, high).exteriorDistance(p) > 0.1F) continue;
    ++near;
    CHECK(held.count(i) == 1);
  }
  CHECK(near > 100);
  CHECK(held.size() < 1500);
}

TEST_CASE("PointGrid's pieces are short and hold each point once", "[prepare]") {
  const geometry::PointGrid grid(scattered(3000, 1), 0.1F);
  std::vector<int> times(grid.size(), 0);
  for (const geometry::GridRun& piece : grid.pieces(0.15F)) {
    REQUIRE(piece.begin < piece.end);
    CHECK(grid.x()[piece.end - 1] - grid.x()[piece.begin] <= 0.15F);
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) ++times[i];
  }
  CHECK(std::count(times.begin(), times.end(), 1) == 3000);
  for (const float length : {-1.0F, std::nanf("")}) CHECK(grid.pieces(length).size() == 3000);
}

}  // namespace posevote::grid_test
