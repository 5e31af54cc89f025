// SPDX-License-Identifier: BSD-3-Clause
// The kernel against the formulas of the paper, and the vector code against it, bit for bit.
#include "nodes/vote/kernel.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "nodes/vote/rotation_cells.hpp"
#include "nodes/vote/scan_votes.hpp"
#include "nodes/vote/sorted_votes.hpp"
#include "tests/support/instruction_set.hpp"
#include "tests/support/votes.hpp"

namespace posevote {
namespace {

constexpr float kDegree = static_cast<float>(std::numbers::pi / 180);

VotePoint vote(const Eigen::Vector3f& t, const Eigen::Quaternionf& q) {
  return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
}

VotePoint negated(const VotePoint& v) { return {v.tx, v.ty, v.tz, -v.qw, -v.qx, -v.qy, -v.qz}; }

TEST_CASE("a vote weighs exactly 1 at itself, whatever the sign", "[vote]") {
  std::mt19937 random(1);
  for (const float sigma_r : {1 * kDegree, 22.5F * kDegree, 90 * kDegree})
    for (int i = 0; i < 1000; ++i) {
      const VotePoint v = vote(test::random_direction(random), test::random_rotation(random));
      const Kernel kernel = make_kernel({0.01F, sigma_r});
      REQUIRE(kernel_units(kernel, v, v) == kWeightUnits);
      REQUIRE(kernel_units(kernel, v, negated(v)) == kWeightUnits);
    }
}

TEST_CASE("the kernel follows the paper, is cut at both bandwidths, and is symmetric", "[vote]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> share(0, 1.2F);
  const float sigma_r = kDegree * GENERATE(1.0F, 22.5F, 60.0F, 90.0F);
  const Bandwidth bandwidth{0.01F, sigma_r};
  const Kernel kernel = make_kernel(bandwidth);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Quaternionf q = test::random_rotation(random);
    const float t_share = share(random), r_share = share(random);
    const Eigen::AngleAxisf turn(r_share * sigma_r, test::random_direction(random));
    const VotePoint a = vote(Eigen::Vector3f::Zero(), q);
    const VotePoint b =
        vote(0.01F * t_share * test::random_direction(random), (turn * q).normalized());
    const std::uint32_t units = kernel_units(kernel, a, b);
    REQUIRE(units == kernel_units(kernel, b, a));
    REQUIRE(units == kernel_units(kernel, negated(a), b));
    if (t_share > 1.0001F || r_share > 1.001F) REQUIRE(units == 0);
    const double expected =
        std::exp(-0.5 * static_cast<double>(t_share * t_share + r_share * r_share));
    // A turn of 1 deg is told from its neighbours to some 1e-5 of itself by float quaternions.
    if (t_share < 0.9999F && r_share < 0.999F)
      REQUIRE(density_of(units) == Approx(expected).epsilon(sigma_r < 0.1F ? 1e-4 : 3e-6));
  }
}

TEST_CASE("scanning equals the kernel bit for bit, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(3);
  const Bandwidth bandwidth{0.01F, 22.5F * kDegree};
  const Kernel kernel = make_kernel(bandwidth);
  const VoteSet votes = test::clustered_votes(random, 6000, 1, 0, bandwidth);
  VoteTable table;
  table.resize(votes.tx.size());
  std::size_t column = 0;
  for (const auto* c :
       {&votes.tx, &votes.ty, &votes.tz, &votes.qw, &votes.qx, &votes.qy, &votes.qz})
    std::copy(c->begin(), c->end(), table[column++]);
  const auto at = [&](std::size_t v) { return vote_point(votes, v); };
  for (std::uint32_t i = 0; i < 300; ++i) {
    const std::uint32_t begin = i * 7, end = i == 299 ? 6000 : begin + i % 70;
    const std::uint32_t middle = std::min(end, begin + i % 5);
    const IndexRange ranges[2] = {{begin, middle}, {middle, end}};
    std::uint64_t expected = 0;
    std::vector<std::uint32_t> back(6000 + kScanPadding, 0), expected_back = back;
    for (std::uint32_t v = begin; v < end; ++v) {
      expected_back[v] = kernel_units(kernel, at(i), at(v));
      expected += expected_back[v];
    }
    REQUIRE(scan_votes(kernel, table.columns(), at(i), ranges, 2, nullptr) == expected);
    REQUIRE(scan_votes(kernel, table.columns(), at(i), ranges, 2, back.data()) == expected);
    REQUIRE(back == expected_back);
  }
  const IndexRange all{0, 6000};
  CHECK(scan_votes(kernel, table.columns(), vote({0, 0, 0}, {1, 0, 0, 0}), &all, 0, nullptr) == 0);
}

TEST_CASE("votes near a box are all copied, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(4);
  const Kernel kernel = make_kernel({0.01F, 0.4F});
  const VoteSet votes = test::spread_votes(random, 1000, 0.05F);
  const SortedVotes sorted = sort_votes(votes, {0.01F, 0.4F});
  const VoteBox box{{-0.003F, -0.002F, -0.004F}, {0.001F, 0.004F, 0}};
  for (const IndexRange range : {IndexRange{0, 1000}, {3, 14}, {17, 17}, {500, 998}}) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const VotePoint p = sorted.votes.at(i);
      const VotePoint nearest{std::clamp(p.tx, box.low[0], box.high[0]),
                              std::clamp(p.ty, box.low[1], box.high[1]),
                              std::clamp(p.tz, box.low[2], box.high[2]),
                              p.qw,
                              p.qx,
                              p.qy,
                              p.qz};
      if (squared_distance(p, nearest) <= kernel.max_dt2) expected.push_back(i);
    }
    VoteTable near;
    near.resize(1000);
    std::vector<std::uint32_t> numbers(1000 + kScanPadding);
    const std::size_t count = copy_near(kernel, sorted.votes.columns(), range, box, near[0],
                                        near.stride(), numbers.data());
    numbers.resize(count);
    REQUIRE(numbers == expected);
    for (std::size_t i = 0; i < count; ++i) {
      const VotePoint copied = near.at(i), original = sorted.votes.at(numbers[i]);
      REQUIRE(std::memcmp(&copied, &original, sizeof copied) == 0);
    }
  }
}

TEST_CASE("every rotation within reach lies in one of a vote's boxes, on every instruction set",
          "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(5);
  const float sigma_r = kDegree * GENERATE(1.0F, 22.5F, 60.0F, 90.0F);
  const Bandwidth bandwidth{0.01F, sigma_r};
  const RotationReach reach = make_rotation_reach(make_kernel(bandwidth), bandwidth);
  std::uniform_real_distribution<float> share(0, 0.9999F);
  VoteSet near;
  std::vector<VotePoint> centers;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Quaternionf q = test::random_rotation(random);
    const Eigen::AngleAxisf turn(share(random) * sigma_r, test::random_direction(random));
    centers.push_back(vote({0, 0, 0}, q));
    test::add_vote(near, {0, 0, 0}, (turn * q).normalized());
  }
  const SortedVotes sorted = sort_votes(near, bandwidth);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const RotationBoxes boxes = rotation_boxes(centers[sorted.numbers[i]], reach);
    const RotationCode code = sorted.codes[i];
    int holding = 0;
    for (std::size_t b = 0; b < boxes.count; ++b) {
      const RotationBox& box = boxes.items[b];
      bool inside = box.chart == chart_of(code);
      for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t level = code >> (16 - 8 * a) & 255U;
        inside = inside && box.low[a] <= level && level <= box.high[a];
      }
      holding += inside;
    }
    REQUIRE(holding == 1);
  }
}

}  // namespace
}  // namespace posevote
