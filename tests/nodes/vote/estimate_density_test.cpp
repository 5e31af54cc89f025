// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "nodes/density/pose_index.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/votes.hpp"

namespace posevote::estimate_density_test {
namespace {

TEST_CASE("estimate_density finds the pose on which votes agree", "[vote]") {
  std::mt19937 random(1);
  VoteSet votes = test::spread_votes(random, 2000, 0.1F);
  const Eigen::Quaternionf q = test::random_rotation(random);
  for (int i = 0; i < 30; ++i)
    test::add_vote(votes, Eigen::Vector3f(0.01F, 0, 0) + 0.002F * test::random_direction(random),
                   q);
  const auto result = test::run_node<VoteDensity>("estimate_density", test::kTenMillimetres, votes);
  REQUIRE(result.density.size() == 2030);
  CHECK(*std::min_element(result.density.begin(), result.density.end()) >= 1);
  CHECK(std::max_element(result.density.begin(), result.density.end()) - result.density.begin() >=
        2000);
  CHECK(result.index->bandwidth().sigma_t == 0.01F);
}

TEST_CASE("estimate_density takes its bandwidths in metres and degrees", "[vote]") {
  VoteSet votes;
  test::add_vote(votes, {0, 0, 0}, Eigen::Quaternionf::Identity());
  test::add_vote(votes, {0.02F, 0, 0},
                 Eigen::Quaternionf(Eigen::AngleAxisf(0.5F, Eigen::Vector3f::UnitX())));
  const auto density = [&](const char* sigma_t, const char* sigma_r) {
    return test::run_node<VoteDensity>("estimate_density",
                                       {{"sigma_t", sigma_t}, {"sigma_r", sigma_r}}, votes)
        .density[0];
  };
  CHECK(density("0.0199", "30") == 1);
  CHECK(density("0.0201", "28.6") == 1);  // 0.5 rad are 28.65 deg
  CHECK(density("0.0201", "28.7") == Approx(1 + std::exp(-1)).epsilon(0.01));
  CHECK_THROWS_AS(density("-1", "20"), std::invalid_argument);
  CHECK_THROWS_AS(density("0.01", "120"), std::invalid_argument);
}

TEST_CASE("the bandwidth follows from the object's size, unless it is said", "[vote]") {
  Model model;
  model.diagonal = 0.5F;
  VoteSet votes;
  votes.model = std::make_shared<const Model>(model);
  const auto sigma_t = [&](const std::map<std::string, std::string>& params) {
    return test::run_node<VoteDensity>("estimate_density", params, votes)
        .index->bandwidth()
        .sigma_t;
  };
  CHECK(sigma_t({}) == Approx(0.03));
  CHECK(sigma_t({{"fraction", "0.1"}}) == Approx(0.05));
  CHECK(sigma_t({{"fraction", "0.1"}, {"sigma_t", "0.01"}}) == 0.01F);
  votes.model = nullptr;
  CHECK(sigma_t(test::kTenMillimetres) == 0.01F);
  CHECK_THROWS_WITH(sigma_t({}), Catch::Contains("of no model"));
}

TEST_CASE("estimate_density of no votes is empty", "[vote]") {
  const auto result =
      test::run_node<VoteDensity>("estimate_density", test::kTenMillimetres, VoteSet{});
  CHECK(result.density.empty());
  REQUIRE(result.index != nullptr);
}

}  // namespace
}  // namespace posevote::estimate_density_test
