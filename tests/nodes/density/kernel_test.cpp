// SPDX-License-Identifier: BSD-3-Clause
// The kernel against the formulas of the paper, and the vector code against it, bit for bit.
#include "nodes/density/kernel.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "nodes/density/near_box.hpp"
#include "nodes/density/rotation_cells.hpp"
#include "nodes/density/scan_votes.hpp"
#include "nodes/density/sorted_votes.hpp"
#include "tests/support/instruction_set.hpp"
#include "tests/support/votes.hpp"

namespace posevote::kernel_test {
namespace {

constexpr float kDegree = static_cast<float>(std::numbers::pi / 180);

density::VotePoint vote(const Eigen::Vector3f& t, const Eigen::Quaternionf& q) {
  return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
}

density::VotePoint negated(const density::VotePoint& v) {
  return {v.tx, v.ty, v.tz, -v.qw, -v.qx, -v.qy, -v.qz};
}

TEST_CASE("a vote weighs exactly 1 at itself, whatever the sign", "[vote]") {
  std::mt19937 random(1);
  for (const float sigma_r : {1 * kDegree, 22.5F * kDegree, 90 * kDegree})
    for (int i = 0; i < 1000; ++i) {
      const density::VotePoint v =
          vote(test::random_direction(random), test::random_rotation(random));
      const density::Kernel kernel = density::make_kernel({0.01F, sigma_r});
      REQUIRE(density::kernel_units(kernel, v, v) == density::kWeightUnits);
      REQUIRE(density::kernel_units(kernel, v, negated(v)) == density::kWeightUnits);
    }
}

TEST_CASE("the kernel follows the paper, is cut at both bandwidths, and is symmetric", "[vote]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> share(0, 1.2F);
  const float sigma_r = kDegree * GENERATE(1.0F, 22.5F, 60.0F, 90.0F);
  const float sigma_t = GENERATE(1e-9F, 1e-5F, 0.01F, 1e9F);
  const density::Bandwidth bandwidth{sigma_t, sigma_r};
  const density::Kernel kernel = density::make_kernel(bandwidth);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaternionf q = test::random_rotation(random);
    const float t_share = share(random), r_share = share(random);
    const Eigen::AngleAxisf turn(r_share * sigma_r, test::random_direction(random));
    const density::VotePoint a = vote(Eigen::Vector3f::Zero(), q);
    const density::VotePoint b =
        vote(sigma_t * t_share * test::random_direction(random), (turn * q).normalized());
    const std::uint32_t units = density::kernel_units(kernel, a, b);
    REQUIRE(units == density::kernel_units(kernel, b, a));
    REQUIRE(units == density::kernel_units(kernel, negated(a), b));
    if (t_share > 1.0001F || r_share > 1.001F) REQUIRE(units == 0);
    const double expected =
        std::exp(-0.5 * static_cast<double>(t_share * t_share + r_share * r_share));
    // A turn of 1 deg is told from its neighbours to some 1e-5 of itself by float quaternions.
    if (t_share < 0.9999F && r_share < 0.999F)
      REQUIRE(density::density_of(units) == Approx(expected).epsilon(sigma_r < 0.1F ? 1e-4 : 3e-6));
  }
}

TEST_CASE("scanning equals the kernel bit for bit, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(3);
  const density::Bandwidth bandwidth{0.01F, 22.5F * kDegree};
  const density::Kernel kernel = density::make_kernel(bandwidth);
  const VoteSet votes = test::clustered_votes(random, 6000, 1, 0, bandwidth);
  density::VoteTable table;
  table.resize(votes.tx.size());
  std::size_t column = 0;
  for (const auto* c :
       {&votes.tx, &votes.ty, &votes.tz, &votes.qw, &votes.qx, &votes.qy, &votes.qz})
    std::copy(c->begin(), c->end(), table[column++]);
  const density::VoteColumns columns = table.columns();
  const auto at = [&](std::size_t v) { return density::vote_point(votes, v); };
  std::vector<std::uint32_t> found(6000 / density::kBlock * density::kFoundPerBlock +
                                   density::kGroup);
  for (std::uint32_t i = 0; i < 300; ++i) {
    const std::uint32_t begin = i, middle = std::min(375U, i + i % 5);
    const std::uint32_t end = i == 7 ? 375 : std::min(375U, middle + i % 13);
    const density::IndexRange ranges[2] = {{begin, middle}, {middle, end}};  // of blocks
    const density::Blocks blocks{ranges, 2};
    const std::size_t count = 1 + i % density::kGroup, first = (i * 61) % 5990;
    density::VotePoint queries[density::kGroup];
    for (std::size_t k = 0; k < count; ++k) queries[k] = at(first + k);
    const auto weight = [&](std::size_t k, std::size_t v) {
      return density::kernel_units(kernel, queries[k], at(v));
    };
    // Alone, and as votes that leave the table one by one.
    std::uint64_t alone[density::kGroup], mutual[density::kGroup],
        expected[density::kGroup] = {}, expected_mutual[density::kGroup] = {};
    std::vector<std::uint32_t> back(6000, 0), expected_back = back;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t v = begin * density::kBlock; v < end * density::kBlock; ++v) {
        expected[k] += weight(k, v);
        if (v >= first && v <= first + k) continue;
        expected_mutual[k] += weight(k, v);
        expected_back[v] += weight(k, v);
      }
    density::scan_votes(kernel, columns, queries, count, blocks, nullptr, found.data(), alone);
    const density::Mutual leaving{table[0] + first, back.data()};
    density::scan_votes(kernel, columns, queries, count, blocks, &leaving, found.data(), mutual);
    for (std::size_t k = 0; k < count; ++k) {
      REQUIRE(alone[k] == expected[k]);
      REQUIRE(mutual[k] == expected_mutual[k]);
      REQUIRE(std::isinf(table[0][first + k]));
      table[0][first + k] = votes.tx[first + k];
    }
    REQUIRE(back == expected_back);
  }
  const density::VotePoint query = at(0);
  std::uint64_t sum = 1;
  density::scan_votes(kernel, columns, &query, 1, {nullptr, 0}, nullptr, found.data(), &sum);
  CHECK(sum == 0);
}

TEST_CASE("votes that left a table, and those beyond its end, are nobody's neighbours", "[vote]") {
  const density::Kernel kernel = density::make_kernel({});
  density::VoteTable table;
  table.resize(5);
  for (std::size_t v = 0; v < density::kBlock; ++v)
    for (std::size_t c = 0; c < density::kVoteColumns; ++c) table[c][v] = c == 3 ? 1 : 0;
  table[0][1] = std::numeric_limits<float>::infinity();
  table.close(5);
  const density::VotePoint query{0, 0, 0, 1, 0, 0, 0};
  const density::IndexRange block{0, 1};
  std::uint32_t found[density::kFoundPerBlock + density::kGroup];
  std::uint64_t sum = 0;
  density::scan_votes(kernel, table.columns(), &query, 1, {&block, 1}, nullptr, found, &sum);
  CHECK(sum == 4 * std::uint64_t{density::kWeightUnits});
}

TEST_CASE("a box holds its votes and touches some, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(6);
  const VoteSet votes = test::spread_votes(random, 300, 1);
  const density::SortedVotes sorted = density::sort_votes(votes, {0.01F, 0.4F});
  for (std::uint32_t begin = 0; begin < 20; ++begin)
    for (std::uint32_t end = begin + 1; end < begin + 40; ++end) {
      const density::VoteBox box = density::bounding_box(sorted.votes.columns(), {begin, end});
      for (std::size_t a = 0; a < 3; ++a) {
        const float* column = sorted.votes.columns()[a];
        REQUIRE(box.low[a] == *std::min_element(column + begin, column + end));
        REQUIRE(box.high[a] == *std::max_element(column + begin, column + end));
      }
    }
}

TEST_CASE("votes near a box are all copied, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(4);
  const density::Kernel kernel = density::make_kernel({0.01F, 0.4F});
  const VoteSet votes = test::spread_votes(random, 1000, 0.05F);
  const density::SortedVotes sorted = density::sort_votes(votes, {0.01F, 0.4F});
  const density::VoteBox box{{-0.003F, -0.002F, -0.004F}, {0.001F, 0.004F, 0}};
  for (const density::IndexRange range :
       {density::IndexRange{0, 1000}, {3, 14}, {17, 17}, {500, 998}}) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const density::VotePoint p = sorted.votes.at(i);
      const density::VotePoint nearest{std::clamp(p.tx, box.low[0], box.high[0]),
                                       std::clamp(p.ty, box.low[1], box.high[1]),
                                       std::clamp(p.tz, box.low[2], box.high[2]),
                                       p.qw,
                                       p.qx,
                                       p.qy,
                                       p.qz};
      if (density::squared_distance(p, nearest) <= kernel.max_dt2) expected.push_back(i);
    }
    density::VoteTable near;
    near.resize(1000);
    std::vector<std::uint32_t> numbers(1000 + density::kScanPadding);
    const std::size_t count = density::copy_near(kernel, sorted.votes.columns(), range, box,
                                                 near[0], near.stride(), numbers.data());
    numbers.resize(count);
    REQUIRE(numbers == expected);
    for (std::size_t i = 0; i < count; ++i) {
      const density::VotePoint copied = near.at(i), original = sorted.votes.at(numbers[i]);
      REQUIRE(std::memcmp(&copied, &original, sizeof copied) == 0);
    }
  }
}

TEST_CASE(
    "every rotation within reach of a group lies in one of its boxes, on every instruction set",
    "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(5);
  const float sigma_r = kDegree * GENERATE(1.0F, 22.5F, 60.0F, 90.0F);
  const std::size_t group = GENERATE(1, 2, 4);
  const float apart = GENERATE(0.1F, 1.0F, 3.14F);  // [rad], of a group
  const density::Kernel kernel = density::make_kernel({0.01F, sigma_r});
  std::uniform_real_distribution<float> share(0, 0.9999F);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaternionf q = test::random_rotation(random);
    std::vector<density::VotePoint> queries;
    const auto turned = [&](const Eigen::Quaternionf& from, float most) {
      const Eigen::AngleAxisf turn(share(random) * most, test::random_direction(random));
      return (turn * from).normalized();
    };
    Eigen::Quaternionf last = q;
    for (std::size_t k = 0; k < group; ++k) {
      last = turned(q, apart);
      queries.push_back(vote({0, 0, 0}, last));
      if (random() % 2 == 0) queries.back() = negated(queries.back());
    }
    const Eigen::Vector4f near = turned(last, sigma_r).coeffs();  // x, y, z, w
    density::RotationCode code = 0;
    density::encode_rotations({&near[3], &near[0], &near[1], &near[2]}, 1, &code);
    const density::RotationBoxes boxes =
        density::rotation_boxes(density::reach_of(kernel, queries.data(), group));
    int holding = 0;
    for (std::size_t b = 0; b < boxes.count; ++b) {
      const density::RotationBox& box = boxes.items[b];
      bool inside = box.chart == density::chart_of(code);
      for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t level = code >> (16 - 8 * a) & 255U;
        inside = inside && box.low[a] <= level && level <= box.high[a];
      }
      holding += inside;
    }
    REQUIRE(holding == 1);
  }
}

TEST_CASE("codes are the same wherever a rotation stands, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(7);
  const VoteSet votes = test::spread_votes(random, 67, 1);
  std::vector<density::RotationCode> all(67);
  const auto encode = [&](std::size_t first, std::size_t count, density::RotationCode* codes) {
    density::encode_rotations(
        {&votes.qw[first], &votes.qx[first], &votes.qy[first], &votes.qz[first]}, count, codes);
  };
  encode(0, 67, all.data());
  for (const density::RotationCode code :
       all)  // the lower bits of a level do not matter, the higher do
    for (const unsigned shift : {0U, 8U, 16U}) {
      CHECK(density::rotation_order(code ^ (31U << shift)) == density::rotation_order(code));
      CHECK(density::rotation_order(code ^ (32U << shift)) != density::rotation_order(code));
    }
  for (std::size_t i = 0; i < 67; ++i) {
    density::RotationCode one = 0;
    encode(i, 1, &one);
    REQUIRE(one == all[i]);
  }
}

}  // namespace
}  // namespace posevote::kernel_test
