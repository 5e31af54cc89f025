// SPDX-License-Identifier: BSD-3-Clause
// The index against a naive sum in doubles, against itself on other thread counts, and subtraction
// against the index of what remains.
#include "nodes/density/pose_index.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "tests/support/instruction_set.hpp"
#include "tests/support/votes.hpp"

namespace posevote::pose_index_test {
namespace {

using test::add_vote;
using test::clustered_votes;
using test::random_rotation;
using test::spread_votes;

constexpr float kDegree = static_cast<float>(std::numbers::pi / 180);

density::VotePoint point(const VoteSet& s, std::size_t v) {
  return {s.tx[v], s.ty[v], s.tz[v], s.qw[v], s.qx[v], s.qy[v], s.qz[v]};
}

/// The project's own predicate, whatever its weights are.
bool is_neighbour(const density::Kernel& kernel, const density::VotePoint& a,
                  const density::VotePoint& b) {
  const float e2 = std::min(density::squared_chord(a, b, 1), density::squared_chord(a, b, -1));
  return density::squared_distance(a, b) <= kernel.max_dt2 && e2 <= kernel.max_e2;
}

/// Eq. 10 in doubles, with exp and acos. Only membership is the project's.
double naive_density(const VoteSet& votes, std::size_t v, density::Bandwidth bandwidth) {
  const density::Kernel kernel = density::make_kernel(bandwidth);
  const density::VotePoint a = point(votes, v);
  const double sigma_t = static_cast<double>(bandwidth.sigma_t);
  const double sigma_r = static_cast<double>(bandwidth.sigma_r);
  double sum = 0;
  for (std::size_t i = 0; i < votes.tx.size(); ++i) {
    const density::VotePoint b = point(votes, i);
    if (!is_neighbour(kernel, a, b)) continue;
    const Eigen::Vector3d t = Eigen::Vector3f(a.tx - b.tx, a.ty - b.ty, a.tz - b.tz).cast<double>();
    const Eigen::Vector4d qa = Eigen::Vector4f(a.qw, a.qx, a.qy, a.qz).cast<double>().normalized();
    const Eigen::Vector4d qb = Eigen::Vector4f(b.qw, b.qx, b.qy, b.qz).cast<double>().normalized();
    const double angle = 2 * std::acos(std::min(1.0, std::abs(qa.dot(qb))));
    REQUIRE(t.norm() <= sigma_t * (1 + 1e-6));
    REQUIRE(angle <= sigma_r + 1e-4);
    sum += std::exp(-t.squaredNorm() / (2 * sigma_t * sigma_t)) *
           std::exp(-angle * angle / (2 * sigma_r * sigma_r));
  }
  return sum;
}

/// Largest relative difference between the index and the naive sum, over at most `samples` votes.
double worst_error(const VoteSet& votes, density::Bandwidth bandwidth, std::size_t samples = 3000) {
  const std::vector<double> density = density::PoseIndex(votes, bandwidth).densities();
  REQUIRE(density.size() == votes.tx.size());
  const std::size_t stride = std::max<std::size_t>(1, votes.tx.size() / samples);
  double worst = 0;
  for (std::size_t v = 0; v < votes.tx.size(); v += stride) {
    const double expected = naive_density(votes, v, bandwidth);
    worst = std::max(worst, std::abs(density[v] - expected) / expected);
    REQUIRE(density[v] >= 1);
  }
  return worst;
}

VoteSet subset(const VoteSet& votes, const std::vector<char>& keep) {
  VoteSet result;
  for (std::size_t v = 0; v < keep.size(); ++v)
    if (keep[v])
      add_vote(result, {votes.tx[v], votes.ty[v], votes.tz[v]},
               {votes.qw[v], votes.qx[v], votes.qy[v], votes.qz[v]});
  return result;
}

TEST_CASE("index densities equal a naive sum in doubles", "[vote]") {
  std::mt19937 random(GENERATE(1, 2, 3, 4, 5));
  const std::size_t count = GENERATE(10, 300, 1500);
  CHECK(worst_error(clustered_votes(random, count, 3, 0.5F, {}), {}) < 1e-4);
  CHECK(worst_error(clustered_votes(random, count, count / 5, 0.05F, {}), {}) < 1e-4);
  CHECK(worst_error(spread_votes(random, count, 0.04F), {}) < 1e-4);
  CHECK(worst_error(spread_votes(random, count, 1), {}) < 1e-4);
}

TEST_CASE("index densities equal a naive sum on many votes", "[vote]") {
  std::mt19937 random(6);
  CHECK(worst_error(clustered_votes(random, 50000, 40, 0.1F, {}), {}, 250) < 1e-4);
  CHECK(worst_error(spread_votes(random, 50000, 0.05F), {}, 250) < 1e-4);
}

TEST_CASE("index densities equal a naive sum at any bandwidth", "[vote]") {
  std::mt19937 random(7);
  const float sigma_t = GENERATE(1e-5F, 0.001F, 0.1F, 5.0F);
  const float sigma_r = kDegree * GENERATE(1.0F, 5.0F, 22.5F, 60.0F, 90.0F);
  const density::Bandwidth bandwidth{sigma_t, sigma_r};
  for (const std::size_t count : {800, 8000}) {  // as they come, and sorted by rotation
    CHECK(worst_error(clustered_votes(random, count, 4, 20 * sigma_t, bandwidth), bandwidth, 200) <
          1e-4);
    CHECK(worst_error(spread_votes(random, count, 3 * sigma_t), bandwidth, 200) < 1e-4);
  }
}

TEST_CASE("votes on the borders of cells and charts are found", "[vote]") {
  VoteSet votes;
  // Translations on multiples of the bandwidth; quaternions whose components tie, with all signs,
  // and turned to just within and beyond the reach.
  for (int i = 0; i < 12000; ++i) {  // many enough to be sorted by rotation
    std::mt19937 random(static_cast<unsigned>(i));
    const auto digit = [&](unsigned n) { return static_cast<float>(random() % n) - 1; };
    const Eigen::Vector3f t = 0.01F * Eigen::Vector3f(digit(4), digit(4), digit(4));
    Eigen::Vector4f tied(digit(3), digit(3), digit(3), digit(3));
    if (tied.isZero()) tied.setOnes();
    const Eigen::Quaternionf q(tied.normalized());
    const Eigen::AngleAxisf turn(digit(3) * 22.5F * kDegree, test::random_direction(random));
    add_vote(votes, t, (turn * q).normalized());
  }
  CHECK(worst_error(votes, {}, 1500) < 1e-4);
  CHECK(worst_error(votes, {0.01F, 90 * kDegree}, 150) < 1e-4);
}

TEST_CASE("votes far away and far apart", "[vote]") {
  std::mt19937 random(8);
  VoteSet votes = clustered_votes(random, 1000, 100, 4000, {0.5F, 0.4F});
  for (const float far : {3e38F, -3e38F, 1e9F})
    add_vote(votes, {far, 0, 0}, random_rotation(random));
  const std::vector<double> density = density::PoseIndex(votes, {0.5F, 0.4F}).densities();
  for (std::size_t v = 0; v < 1000; ++v)
    REQUIRE(density[v] == Approx(naive_density(votes, v, {0.5F, 0.4F})).epsilon(1e-4));
  CHECK(density[1000] == 0);
}

TEST_CASE("a vote alone has density 1, equal votes their number", "[vote]") {
  std::mt19937 random(9);
  const Eigen::Quaternionf q = random_rotation(random);
  VoteSet votes;
  add_vote(votes, {1, 2, 3}, q);
  CHECK(density::PoseIndex(votes, {}).densities() == std::vector<double>{1});
  for (int i = 1; i < 5000; ++i)
    add_vote(votes, {1, 2, 3}, i % 2 ? q : Eigen::Quaternionf(-q.w(), -q.x(), -q.y(), -q.z()));
  CHECK((density::PoseIndex(votes, {}).densities() == std::vector<double>(5000, 5000)));
}

TEST_CASE("a crowded cell and small ones behind it", "[vote]") {
  // More than are looked at at once, then a cell that makes one batch with the last of them.
  VoteSet votes;
  const Eigen::Quaternionf q = Eigen::Quaternionf::Identity();
  for (int i = 0; i < 4100; ++i) add_vote(votes, {0.005F, 0.005F, 0.005F}, q);
  for (int i = 0; i < 10; ++i) add_vote(votes, {0.005F, 0.005F, 0.0125F}, q);
  const double weight = density::density_of(
      density::kernel_units(density::make_kernel({}), point(votes, 0), point(votes, 4100)));
  std::vector<double> expected(4100, 4100 + 10 * weight);
  expected.resize(4110, 10 + 4100 * weight);
  CHECK((density::PoseIndex(votes, {}).densities() == expected));
}

TEST_CASE("more equal votes than 32 bits hold weights of, on every instruction set", "[vote]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  VoteSet votes;
  for (int i = 0; i < 17000; ++i) add_vote(votes, {0, 0, 0}, Eigen::Quaternionf::Identity());
  CHECK((density::PoseIndex(votes, {}).densities() == std::vector<double>(17000, 17000)));
}

TEST_CASE("no votes, no densities", "[vote]") {
  const density::PoseIndex index(VoteSet{}, {});
  std::vector<double> density;
  index.subtract({}, {}, density);
  CHECK(index.densities().empty());
  CHECK(index.neighbours({0, 0, 0}, Eigen::Quaternionf::Identity()).empty());
}

TEST_CASE("votes that are no poses count nowhere", "[vote]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  VoteSet votes;
  const auto identity = Eigen::Quaternionf::Identity();
  add_vote(votes, {0, 0, 0}, identity);
  add_vote(votes, {nan, 0, 0}, identity);
  add_vote(votes, {0, 0, inf}, identity);
  add_vote(votes, {0, 0, 0}, {nan, 0, 0, 0});
  add_vote(votes, {0, 0, 0}, {0, 0, 0, 0});
  add_vote(votes, {0, 0, 0}, {2, 0, 0, 0});
  add_vote(votes, {0, 0, 0}, identity);
  const density::PoseIndex index(votes, {});
  std::vector<double> density = index.densities();
  CHECK(density == std::vector<double>{2, 0, 0, 0, 0, 0, 2});
  index.subtract({0, 1}, {0, 0, 1, 1, 1, 1, 1}, density);
  CHECK(density == std::vector<double>{0, 0, 0, 0, 0, 0, 1});
  CHECK(index.neighbours({0, 0, nan}, identity).empty());
  CHECK_THROWS_AS(index.subtract({0}, {0}, density), std::invalid_argument);
}

TEST_CASE("impossible bandwidths are refused", "[vote]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const density::Bandwidth bad :
       {density::Bandwidth{0, 0.4F}, density::Bandwidth{-1, 0.4F}, density::Bandwidth{nan, 0.4F},
        density::Bandwidth{0.01F, 0}, density::Bandwidth{0.01F, 2}, density::Bandwidth{0.01F, nan}})
    CHECK_THROWS_AS(density::PoseIndex(VoteSet{}, bad), std::invalid_argument);
}

TEST_CASE("the same bits at any thread count and in any order", "[vote]") {
  std::mt19937 random(10);
  const VoteSet votes = clustered_votes(random, 20000, 20, 0.1F, {});
  std::vector<double> once;
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<double> density = density::PoseIndex(votes, {}).densities();
    if (once.empty()) once = density;
    CHECK((density == once));
  }
  VoteSet reversed;
  for (std::size_t v = votes.tx.size(); v-- > 0;)
    add_vote(reversed, {votes.tx[v], votes.ty[v], votes.tz[v]},
             {votes.qw[v], votes.qx[v], votes.qy[v], votes.qz[v]});
  std::reverse(once.begin(), once.end());
  CHECK((density::PoseIndex(reversed, {}).densities() == once));
}

TEST_CASE("subtraction equals the index of the remaining votes", "[vote]") {
  std::mt19937 random(11);
  const VoteSet votes =
      GENERATE_REF(clustered_votes(random, 12000, 3, 0.1F, {}), spread_votes(random, 4000, 0.05F));
  const density::PoseIndex index(votes, {});
  std::vector<double> density = index.densities();
  std::vector<char> alive(density.size(), 1);
  for (const double share : {0.0, 0.001, 0.1, 0.4, 0.8}) {
    std::vector<std::uint32_t> removed;
    std::bernoulli_distribution goes(share);
    for (std::uint32_t v = 0; v < alive.size(); ++v)
      if (alive[v] && goes(random)) alive[v] = 0, removed.push_back(v);
    index.subtract(removed, alive, density);
    const std::vector<double> expected = density::PoseIndex(subset(votes, alive), {}).densities();
    std::vector<double> actual;
    for (std::size_t v = 0; v < alive.size(); ++v) {
      if (alive[v]) actual.push_back(density[v]);
      if (!alive[v]) REQUIRE(density[v] == 0);
    }
    REQUIRE((actual == expected));
  }
}

TEST_CASE("neighbours are the votes that make a density", "[vote]") {
  std::mt19937 random(12);
  const VoteSet votes = clustered_votes(random, 3000, 6, 0.1F, {});
  const density::PoseIndex index(votes, {});
  const std::vector<double> density = index.densities();
  for (std::size_t v = 0; v < votes.tx.size(); v += 37) {
    const density::VotePoint p = point(votes, v);
    const auto found = index.neighbours({p.tx, p.ty, p.tz}, {p.qw, p.qx, p.qy, p.qz});
    double sum = 0;
    for (const density::WeightedVote& n : found) sum += static_cast<double>(n.weight);
    REQUIRE(sum == density[v]);
    std::set<std::uint32_t> once;
    for (const density::WeightedVote& n : found) once.insert(n.vote);
    REQUIRE(once.size() == found.size());
    REQUIRE(once.count(static_cast<std::uint32_t>(v)) == 1);
  }
  CHECK(index.bandwidth().sigma_t == 0.01F);
}

}  // namespace
}  // namespace posevote::pose_index_test
