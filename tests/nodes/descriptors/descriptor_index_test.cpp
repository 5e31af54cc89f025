// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/descriptor_index.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "nodes/descriptors/descriptor_kernels.hpp"
#include "nodes/descriptors/principal_axes.hpp"
#include "tests/support/instruction_set.hpp"

namespace posevote::descriptor_index_test {
namespace {

DescriptorMatrix random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  DescriptorMatrix matrix(rows, columns);
  for (float& value : matrix.reshaped()) value = static_cast<float>(random()) / 4294967296.0F;
  return matrix;
}

/// Rows of which six axes hold nearly all, as descriptors of surfaces are.
DescriptorMatrix flat_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  return random_matrix(rows, 6, seed) * random_matrix(6, columns, 99) +
         0.1F * random_matrix(rows, columns, seed + 1000);
}

/// The definition: smallest distance in double, of equals the smallest row.
descriptors::TwoNearest naive(const DescriptorMatrix& rows, const DescriptorMatrix& queries,
                              Eigen::Index query) {
  std::vector<std::pair<double, std::uint32_t>> all;
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    double sum = 0;
    for (Eigen::Index k = 0; k < rows.cols(); ++k) {
      const double d = static_cast<double>(rows(row, k)) - static_cast<double>(queries(query, k));
      sum += d * d;
    }
    all.emplace_back(sum, static_cast<std::uint32_t>(row));
  }
  std::sort(all.begin(), all.end());
  const auto& second = all[all.size() > 1 ? 1 : 0];
  return {{all[0].second, second.second},
          {static_cast<float>(all[0].first), static_cast<float>(second.first)}};
}

/// How many queries were not answered exactly as by the definition.
int mistakes(const DescriptorMatrix& rows, const DescriptorMatrix& queries,
             const std::string& search) {
  const auto nearest = descriptors::DescriptorIndex({rows}, {search}).nearest_two(queries);
  int wrong = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const descriptors::TwoNearest expected = naive(rows, queries, static_cast<Eigen::Index>(i));
    wrong += !std::equal(expected.row, expected.row + 2, nearest[i].row) ||
             !std::equal(expected.squared, expected.squared + 2, nearest[i].squared);
  }
  return wrong + static_cast<int>(nearest.size()) - static_cast<int>(queries.rows());
}

}  // namespace

TEST_CASE("exact search equals the definition at every size", "[match]") {
  for (const std::string search : {"exact", "kd_tree"})
    for (const Eigen::Index rows : {1, 2, 31, 33, 2049, 2500})
      for (const Eigen::Index columns : {1, 33, 240}) {
        INFO(search << " " << rows << " x " << columns);
        CHECK(mistakes(random_matrix(rows, columns, 1), random_matrix(97, columns, 2), search) ==
              0);
      }
}

TEST_CASE("exact search of short descriptors equals the definition", "[match]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  for (const Eigen::Index rows : {2, 70, 2500}) {
    INFO(rows);
    const DescriptorMatrix all = flat_matrix(rows, 150, 1);
    DescriptorMatrix queries = flat_matrix(100, 150, 2);
    CHECK(descriptors::PrincipalAxes(all).length() == 64);
    queries.topRows(50) = random_matrix(50, 150, 7);  // unlike the rows
    queries.row(50) = all.row(1);                     // one of the rows
    queries.row(51).setZero();
    queries.row(52) *= 1e6F;
    CHECK(mistakes(all, queries, "exact") == 0);
    CHECK(mistakes(1e-20F * all, 1e-20F * queries, "exact") == 0);
    CHECK(mistakes(1e30F * all, 1e30F * queries, "exact") == 0);
    CHECK(mistakes(all.array() + 1000, queries.array() + 1000, "exact") == 0);
  }
  const DescriptorMatrix same = random_matrix(1, 150, 1).replicate(100, 1);
  CHECK(mistakes(same, flat_matrix(20, 150, 2), "exact") == 0);
}

TEST_CASE("short descriptors lie no farther apart than long ones", "[match]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const DescriptorMatrix rows = flat_matrix(400, 150, 1);
  DescriptorMatrix queries = flat_matrix(30, 150, 2);
  queries.topRows(10) = random_matrix(10, 150, 7);
  const descriptors::PrincipalAxes axes(rows);
  REQUIRE(axes.length() == 64);
  const DescriptorMatrix a = axes.shorten(rows, 0, 400), b = axes.shorten(queries, 0, 30);
  CHECK(axes.shorten(rows, 123, 7) == a.middleRows(123, 7));
  double most = 0;
  for (Eigen::Index i = 0; i < 400; ++i)
    for (Eigen::Index k = 0; k < 30; ++k) {
      const float length = a.row(i).norm() + b.row(k).norm();
      const float brief = (a.row(i) - b.row(k)).norm(),
                  whole = (rows.row(i) - queries.row(k)).norm();
      REQUIRE(brief <= whole + descriptors::PrincipalAxes::kMoves * length);
      most = std::max(most, static_cast<double>(brief / whole));
    }
  CHECK(most > 0.9);  // and not much nearer
}

TEST_CASE("the kernels of exact search keep what is not a number", "[match]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<float> scores(100 + descriptors::kKernelPadding, 5);
  scores[7] = 1;
  scores[99] = 2;
  std::vector<std::uint32_t> found(100 + descriptors::kKernelPadding);
  CHECK(descriptors::second_lowest(scores.data(), 100) == 2);
  CHECK(descriptors::second_lowest(scores.data(), 99) == 5);
  CHECK(descriptors::second_lowest(scores.data() + 7, 1) == inf);
  CHECK(descriptors::find_low(scores.data(), 99, 2, found.data()) == 1);
  CHECK(descriptors::find_low(scores.data(), 100, 2, found.data()) == 2);
  CHECK(found[1] == 99);
  scores[50] = std::numeric_limits<float>::quiet_NaN();
  CHECK(std::isnan(descriptors::second_lowest(scores.data(), 100)));
  CHECK(descriptors::find_low(scores.data(), 100, 2, found.data()) == 3);
  CHECK(found[1] == 50);
  CHECK(descriptors::find_low(scores.data(), 37, scores[50], found.data()) == 37);
}

TEST_CASE("distances have the same bits on every instruction set", "[match]") {
  const DescriptorMatrix rows = random_matrix(2, 249, 1);
  const double best = descriptors::squared_distance(rows.data(), rows.data() + 249, 249);
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  CHECK(descriptors::squared_distance(rows.data(), rows.data() + 249, 249) == best);
  CHECK(best == Approx((rows.row(0) - rows.row(1)).squaredNorm()));
  CHECK(descriptors::squared_distance(rows.data(), rows.data() + 249, 0) == 0);
}

TEST_CASE("of equally near rows the smaller comes first", "[match]") {
  for (const std::string search : {"exact", "kd_tree"}) {
    INFO(search);
    const DescriptorMatrix once = random_matrix(60, 20, 3);
    DescriptorMatrix rows(300, 20);
    rows << once, once, once, once, once;
    CHECK(mistakes(rows, random_matrix(50, 20, 4), search) == 0);
    const auto same = descriptors::DescriptorIndex({rows}, {search}).nearest_two(once);
    CHECK(same[7].row[0] == 7);
    CHECK(same[7].row[1] == 67);
    CHECK(same[7].squared[1] == 0);
  }
}

TEST_CASE("exact search stays exact where float products cancel", "[match]") {
  DescriptorMatrix rows = random_matrix(3000, 64, 5);
  DescriptorMatrix queries = random_matrix(40, 64, 6);
  rows.array() = 1000 + 0.01F * rows.array();
  queries.array() = 1000 + 0.01F * queries.array();
  CHECK(mistakes(rows, queries, "exact") == 0);
  rows *= 1e30F;  // |b|^2 is beyond float, and so are the products
  queries *= 1e30F;
  CHECK(mistakes(rows, queries, "exact") == 0);
}

TEST_CASE("exact search stays exact whatever the size of the numbers", "[match]") {
  // Steps of 16 bits follow the longest descriptor; where floats are too coarse for a step, or all
  // rows are alike, every row must be compared.
  for (const float size : {1e-30F, 1e-18F, 1.0F, 1e15F}) {
    const DescriptorMatrix rows = size * random_matrix(300, 33, 21);
    const DescriptorMatrix queries = size * random_matrix(40, 33, 22);
    CHECK(mistakes(rows, queries, "exact") == 0);
  }
  DescriptorMatrix uneven = random_matrix(300, 33, 23);
  uneven.row(7) *= 2000;  // all others are a few steps long
  uneven.col(5) *= 0.001F;
  CHECK(mistakes(uneven, random_matrix(40, 33, 24), "exact") == 0);
  const DescriptorMatrix alike = DescriptorMatrix::Constant(70, 33, 0.5F);
  CHECK(mistakes(alike, random_matrix(10, 33, 25), "exact") == 0);
}

TEST_CASE("rows are counted through all blocks, empty ones too", "[match]") {
  const DescriptorMatrix a = random_matrix(5, 8, 1), none, b = random_matrix(40, 8, 2);
  const auto nearest = descriptors::DescriptorIndex({a, none, b}, {}).nearest_two(b);
  for (std::uint32_t i = 0; i < 40; ++i) CHECK(nearest[i].row[0] == i + 5);
}

TEST_CASE("the approximate forest mostly finds the nearest, and says what it is", "[match]") {
  const DescriptorMatrix rows = random_matrix(2000, 8, 1);
  const descriptors::DescriptorIndex index({rows}, {"approximate", 4, 512});
  CHECK_FALSE(index.reproducible());
  CHECK(descriptors::DescriptorIndex({rows}, {"kd_tree"}).reproducible());
  CHECK(descriptors::DescriptorIndex({rows}, {"exact"}).reproducible());
  CHECK(mistakes(rows, random_matrix(200, 8, 2), "approximate") < 20);
  const DescriptorMatrix one = rows.topRows(1);
  CHECK(descriptors::DescriptorIndex({one}, {"approximate"}).nearest_two(one)[0].squared[1] == 0);
}

TEST_CASE("each block is searched by itself, and the smallest ratio decides", "[match]") {
  const DescriptorMatrix left = random_matrix(300, 5, 1), right = random_matrix(300, 12, 2);
  const DescriptorMatrix left_queries = random_matrix(70, 5, 3);
  const DescriptorMatrix right_queries = random_matrix(70, 12, 4);
  DescriptorMatrix rows(300, 17), queries(70, 17);
  rows << left, right;
  queries << left_queries, right_queries;
  for (const std::string search : {"exact", "kd_tree"}) {
    INFO(search);
    const auto fused =
        descriptors::DescriptorIndex({rows}, {search}, {5, 12}).nearest_two(queries, {5, 12});
    REQUIRE(fused.size() == 70);
    int by_left = 0;
    for (std::size_t i = 0; i < fused.size(); ++i) {
      const descriptors::TwoNearest a = naive(left, left_queries, static_cast<Eigen::Index>(i));
      const descriptors::TwoNearest b = naive(right, right_queries, static_cast<Eigen::Index>(i));
      const bool is_left = descriptors::squared_ratio(a) <= descriptors::squared_ratio(b);
      by_left += is_left;
      CHECK(fused[i].row[0] == (is_left ? a : b).row[0]);
      CHECK(fused[i].squared[1] == (is_left ? a : b).squared[1]);
    }
    CHECK(by_left > 0);
    CHECK(by_left < 70);
  }
}

TEST_CASE("of blocks with equal ratios the first decides", "[match]") {
  DescriptorMatrix rows(3, 2), query(1, 2);
  rows << 0, 5, 3, 0, 9, 2;  // nearest by the first number is row 0, by the second row 1
  query << 1, 1;
  const descriptors::DescriptorIndex index({rows}, {}, {1, 1});
  CHECK(index.nearest_two(query, {1, 1})[0].row[0] == 0);  // 1 : 4
  query << 1, 1;
  rows << 0, 3, 3, 0, 9, 9;
  CHECK(descriptors::DescriptorIndex({rows}, {}, {1, 1}).nearest_two(query, {1, 1})[0].row[0] == 0);
  query << 1, 0.5F;  // 0.25 : 6.25 beats 1 : 4
  CHECK(descriptors::DescriptorIndex({rows}, {}, {1, 1}).nearest_two(query, {1, 1})[0].row[0] == 1);
}

TEST_CASE("blocks that are not the columns are refused, and other blocks too", "[match]") {
  const DescriptorMatrix a = random_matrix(3, 8, 1);
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {}, {3, 4}),
                    Catch::Contains("8 numbers in blocks of 3 4"));
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {}, {8, 0}), Catch::Contains("no columns"));
  const std::uint32_t wrap = std::numeric_limits<std::uint32_t>::max();
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {}, {wrap, 9}), Catch::Contains("blocks of"));
  const descriptors::DescriptorIndex fused({a}, {}, {3, 5});
  CHECK_THROWS_WITH(fused.nearest_two(a, {5, 3}),
                    Catch::Contains("blocks of 5 3, the library's blocks of 3 5"));
  CHECK_THROWS_WITH(fused.nearest_two(a), Catch::Contains("are one descriptor"));
  CHECK(fused.nearest_two(a, {3, 5})[2].row[0] == 2);
}

TEST_CASE("options of the search are refused where they are out of range", "[match]") {
  const DescriptorMatrix a = random_matrix(3, 8, 1);
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {"approximate", 0, 5}),
                    Catch::Contains("trees is 0"));
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {"approximate", 65, 5}),
                    Catch::Contains("at most 64"));
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {"approximate", 4, 1}),
                    Catch::Contains("checks is 1"));
}

TEST_CASE("an index refuses what it cannot search", "[match]") {
  const DescriptorMatrix none, a = random_matrix(3, 8, 1), b = random_matrix(3, 9, 1);
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({}, {}), Catch::Contains("no descriptors"));
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({none}, {}), Catch::Contains("no descriptors"));
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a, b}, {}),
                    Catch::Contains("of 9 and of 8 numbers"));
  CHECK_THROWS_WITH(descriptors::DescriptorIndex({a}, {"guess"}), Catch::Contains("guess"));
  const descriptors::DescriptorIndex index({a}, {});
  CHECK(index.nearest_two(none).empty());
  CHECK_THROWS_WITH(index.nearest_two(b), Catch::Contains("have 9 numbers, the library's 8"));
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    DescriptorMatrix broken = a;
    broken(1, 1) = bad;
    CHECK_THROWS_WITH(descriptors::DescriptorIndex({broken}, {}), Catch::Contains("not finite"));
    CHECK_THROWS_WITH(index.nearest_two(broken), Catch::Contains("not finite"));
  }
}

}  // namespace posevote::descriptor_index_test
