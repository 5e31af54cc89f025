// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/live_votes.hpp"

#include <catch2/catch.hpp>

#include "nodes/density/pose_index.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::live_votes_test {

using namespace posevote::test;

namespace {

struct Scene {
  FeatureSet features;
  Correspondences matches;
  VoteSet votes;
  VoteDensity density;
};

Scene make_scene() {
  const Placed body{1, pose(0, 0, 0.8, 0.7)};
  Scene scene;
  const Cloud scan = scan_of({body});
  scene.features = features_of(scan, 12);
  scene.matches = match_truly(bumpy_model(1), scene.features, {body}, 0.5, 30);
  scene.votes = run_node<VoteSet>("cast_votes", {}, scene.matches, scene.features);
  const auto index = std::make_shared<density::PoseIndex>(scene.votes, density::Bandwidth{});
  scene.density = {index->densities(), index};
  return scene;
}

/// The densities if the votes that are not alive had never been cast.
std::vector<double> voted_anew(const VoteSet& all, const std::vector<char>& alive) {
  VoteSet rest;
  rest.model = all.model;
  rest.votes_per_correspondence = 1;
  const auto column = [&alive](const std::vector<float>& from) {
    std::vector<float> kept;
    for (std::size_t v = 0; v < from.size(); ++v)
      if (alive[v]) kept.push_back(from[v]);
    return kept;
  };
  rest.tx = column(all.tx), rest.ty = column(all.ty), rest.tz = column(all.tz);
  rest.qw = column(all.qw), rest.qx = column(all.qx), rest.qy = column(all.qy);
  rest.qz = column(all.qz);
  rest.scene_feature.assign(rest.tx.size(), 0);
  return density::PoseIndex(rest, density::Bandwidth{}).densities();
}

}  // namespace

TEST_CASE("what is explained step by step leaves the densities of voting anew", "[segment]") {
  const Scene scene = make_scene();
  segment::LiveVotes object = segment::all_votes(scene.votes, scene.density);
  std::vector<char> explained(static_cast<std::size_t>(scene.features.points.rows()), 0);
  for (const std::size_t every : {7U, 3U, 2U}) {
    for (std::size_t i = 0; i < explained.size(); i += every) explained[i] = 1;
    segment::remove_explained(object, explained);
    const std::vector<double> expected = voted_anew(scene.votes, object.alive);
    REQUIRE(!expected.empty());
    std::vector<double> left;
    double dead = 0;
    for (std::size_t v = 0; v < object.density().size(); ++v) {
      CHECK_FALSE((object.alive[v] && explained[scene.votes.scene_feature[v / 60]]));
      if (object.alive[v])
        left.push_back(object.density()[v]);
      else
        dead += std::abs(object.density()[v]);
    }
    CHECK(dead == 0);
    CHECK(left == expected);  // to the last bit: weights are multiples of 2^-22
  }
}

TEST_CASE("all explained leaves nothing", "[segment]") {
  const Scene scene = make_scene();
  segment::LiveVotes object = segment::all_votes(scene.votes, scene.density);
  segment::remove_explained(
      object, std::vector<char>(static_cast<std::size_t>(scene.features.points.rows()), 1));
  for (const double density : object.density()) CHECK(density == 0);
}

TEST_CASE("a single vote goes with its feature", "[segment]") {
  Scene scene = make_scene();
  const std::size_t circles = scene.votes.circle_votes();
  for (const std::uint32_t feature : {4U, 5U, 4U})
    scene.votes.add_single({0, 0, 0.8F}, Eigen::Quaternionf::Identity(), feature);
  const auto index = std::make_shared<density::PoseIndex>(scene.votes, density::Bandwidth{});
  scene.density = {index->densities(), index};
  REQUIRE(scene.density.density.size() == circles + 3);
  CHECK(scene.density.density[circles] >= 3);
  segment::LiveVotes object = segment::all_votes(scene.votes, scene.density);
  std::vector<char> explained(static_cast<std::size_t>(scene.features.points.rows()), 0);
  explained[4] = 1;
  segment::remove_explained(object, explained);
  CHECK(object.density()[circles] == 0);
  CHECK(object.density()[circles + 1] == Approx(scene.density.density[circles + 1] - 2));
  CHECK(object.density()[circles + 2] == 0);
}

TEST_CASE("inputs that do not belong together are refused", "[segment]") {
  const Scene scene = make_scene();
  const auto features = static_cast<std::size_t>(scene.features.points.rows());
  const auto check = [features](const VoteSet& votes, const VoteDensity& density) {
    segment::check_votes({{std::make_shared<const VoteSet>(votes)}},
                         {{std::make_shared<const VoteDensity>(density)}}, features);
  };
  CHECK_NOTHROW(check(scene.votes, scene.density));
  CHECK_THROWS_AS(
      segment::check_votes({{std::make_shared<const VoteSet>(scene.votes)}}, {}, features),
      std::runtime_error);
  VoteSet broken = scene.votes;
  broken.qz.pop_back();
  CHECK_THROWS_WITH(check(broken, scene.density), Catch::Contains("bumpy1"));
  broken = scene.votes;
  broken.scene_feature[3] = 1000000;
  CHECK_THROWS_WITH(check(broken, scene.density), Catch::Contains("scene feature 1000000"));
  broken = scene.votes;
  broken.add_single({0, 0, 0}, Eigen::Quaternionf::Identity(), 2000000);
  broken.scene_feature[3] = 0;
  VoteDensity one_more = scene.density;
  one_more.density.push_back(0);
  const auto check_single = [&] { check(broken, one_more); };
  CHECK_THROWS_WITH(check_single(), Catch::Contains("scene feature 2000000"));
  broken = scene.votes;
  broken.model = nullptr;
  CHECK_THROWS_AS(check(broken, scene.density), std::runtime_error);
  broken = scene.votes;
  broken.votes_per_correspondence = 0;
  CHECK_THROWS_AS(check(broken, scene.density), std::runtime_error);
  VoteDensity short_density = scene.density;
  short_density.density.pop_back();
  CHECK_THROWS_AS(check(scene.votes, short_density), std::runtime_error);
  short_density = scene.density;
  short_density.index = nullptr;
  CHECK_THROWS_WITH(check(scene.votes, short_density), Catch::Contains("index"));
}

}  // namespace posevote::live_votes_test
