// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/strewn.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "nodes/geometry/curve_order.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::strewn_test {

using geometry::Strewn;

TEST_CASE("of every few one is strewn", "[geometry]") {
  for (const auto& [count, wanted] : {std::pair{1000, 300}, {1000, 999}, {7, 3}, {1, 5}}) {
    const Strewn some(count, wanted);
    const std::vector<Eigen::Index> numbers = some.numbers();
    REQUIRE(numbers.size() == some.size());
    CHECK(numbers.size() <= static_cast<std::size_t>(wanted));
    CHECK(numbers.size() >= static_cast<std::size_t>(std::min(count, wanted + 1)) / 2);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      CHECK(numbers[k] / some.stride() == static_cast<Eigen::Index>(k));
      CHECK(numbers[k] < count);
    }
  }
  CHECK(Strewn(5, 0).numbers() == std::vector<Eigen::Index>{0, 1, 2, 3, 4});
  CHECK(Strewn(0, 0).numbers().empty());
  CHECK(Strewn(0, 10).numbers().empty());
}

TEST_CASE("what comes in turns is strewn alike", "[geometry]") {
  for (const Eigen::Index turns : {2, 3, 8}) {
    std::vector<int> of_each(static_cast<std::size_t>(turns), 0);
    const Strewn some(24000, 1040);
    REQUIRE(some.stride() == 24);
    for (const Eigen::Index number : some.numbers())
      ++of_each[static_cast<std::size_t>(number % turns)];
    const double expected = static_cast<double>(some.size()) / static_cast<double>(turns);
    for (const int one : of_each) CHECK(one == Approx(expected).epsilon(0.25));
  }
}

TEST_CASE("along the curve neighbours follow one another", "[geometry]") {
  constexpr float kEdge = 0.001F;
  PointMatrix points(8002, 3);
  points.topRows(8000) = test::sphere(8000, 0.05F);
  points.row(8000).setConstant(std::numeric_limits<float>::quiet_NaN());
  points.row(8001) << 0, std::numeric_limits<float>::infinity(), 0;
  std::vector<std::uint32_t> rows = geometry::rows_along_curve(points, kEdge);
  REQUIRE(rows.size() == 8000);
  double way = 0;
  for (std::size_t k = 1; k < rows.size(); ++k)
    way += static_cast<double>((points.row(rows[k]) - points.row(rows[k - 1])).norm());
  CHECK(way / 8000 < 4 * std::sqrt(4 * 3.1416 * 0.05 * 0.05 / 8000));  // x the mean spacing
  // A piece of it is no stripe around the body.
  const std::vector<std::uint32_t> piece(rows.begin() + 2000, rows.begin() + 2100);
  const PointMatrix there = points(piece, Eigen::all);
  CHECK((there.colwise().maxCoeff() - there.colwise().minCoeff()).maxCoeff() < 0.04F);
  std::ranges::sort(rows);
  for (std::size_t k = 0; k < rows.size(); ++k) CHECK(rows[k] == k);
}

TEST_CASE("the curve goes through anything", "[geometry]") {
  CHECK(geometry::rows_along_curve(PointMatrix(0, 3), 1).empty());
  PointMatrix points(3, 3);
  points << 0, 0, 0, 1e9F, 0, 0, 1, 0, 0;  // more cubes than there are numbers
  CHECK(geometry::rows_along_curve(points, 1e-6F).size() == 3);
  points.setZero();
  CHECK(geometry::rows_along_curve(points, 1) == std::vector<std::uint32_t>{0, 1, 2});
}

}  // namespace posevote::strewn_test
