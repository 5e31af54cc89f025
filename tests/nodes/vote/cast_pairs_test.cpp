// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>
#include <optional>

#include "nodes/data/votes.hpp"
#include "nodes/pairs/pair_table.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::cast_pairs_test {

using namespace posevote::test;

namespace {

/// `light`: its colour, if it has any.
std::shared_ptr<const Model> model_with_pairs(int shape,
                                              std::optional<Eigen::RowVector3f> light = {}) {
  auto model = std::make_shared<Model>(*bumpy_model(shape));
  if (light) model->cloud.colors = light->replicate(model->cloud.points.rows(), 1);
  model->pairs = pairs::index_pairs(*model, 0.07F * model->diagonal);
  return model;
}

VoteSet no_votes(const std::shared_ptr<const Model>& model) {
  VoteSet votes;
  votes.model = model;
  votes.votes_per_correspondence = 60;
  return votes;
}

PerObject<VoteSet> given(const std::vector<VoteSet>& sets) {
  PerObject<VoteSet> all;
  for (const VoteSet& votes : sets) all.slots.push_back(std::make_shared<const VoteSet>(votes));
  return all;
}

PerObject<VoteSet> cast(const std::vector<VoteSet>& sets, const FeatureSet& features,
                        const Cloud& cloud, const std::map<std::string, std::string>& params = {}) {
  return run_node<PerObject<VoteSet>>("cast_pairs", params, given(sets), features, cloud);
}

/// The votes within a tenth of the diagonal and 15 deg of a pose.
std::size_t near(const VoteSet& votes, const Eigen::Isometry3d& T_scene_model) {
  const Eigen::Vector3f center = (T_scene_model * votes.model->center.cast<double>()).cast<float>();
  const Eigen::Quaternionf rotation(T_scene_model.linear().cast<float>());
  std::size_t count = 0;
  for (std::size_t v = 0; v < votes.tx.size(); ++v)
    if ((Eigen::Vector3f(votes.tx[v], votes.ty[v], votes.tz[v]) - center).norm() <
            0.1F * votes.model->diagonal &&
        Eigen::Quaternionf(votes.qw[v], votes.qx[v], votes.qy[v], votes.qz[v])
                .angularDistance(rotation) < 0.26F)
      ++count;
  return count;
}

bool same(const VoteSet& a, const VoteSet& b) {
  return a.scene_feature == b.scene_feature && a.single_feature == b.single_feature &&
         a.tx == b.tx && a.ty == b.ty && a.tz == b.tz && a.qw == b.qw && a.qx == b.qx &&
         a.qy == b.qy && a.qz == b.qz;
}

struct Scene {
  std::vector<Placed> bodies{// before a wall, where most features are
                             {1, pose(0, 0, 0.8, 0.7)},
                             {2, pose(0.12, 0.02, 0.9, 2.1)}};
  Cloud cloud = scan_of(bodies);
  FeatureSet features = features_of(cloud, 12);
};

}  // namespace

TEST_CASE("pairs vote for where the objects are", "[vote]") {
  const Scene scene;
  const auto votes = cast({no_votes(model_with_pairs(1)), no_votes(model_with_pairs(2))},
                          scene.features, scene.cloud);
  REQUIRE(votes.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t all = votes[i].size();
    CHECK(votes[i].tx.size() == all);
    CHECK(near(votes[i], scene.bodies[i].T_scene_model) > all / 6);
    CHECK(near(votes[i], scene.bodies[1 - i].T_scene_model) < all / 50);
  }
}

TEST_CASE("votes of pairs come behind those that are there", "[vote]") {
  const Scene scene;
  VoteSet before = no_votes(model_with_pairs(1));
  before.votes_per_correspondence = 1;
  before.scene_feature = {3};
  before.tx = before.ty = before.tz = before.qx = before.qy = before.qz = {0};
  before.qw = {1};
  const VoteSet votes = cast({before}, scene.features, scene.cloud)[0];
  CHECK(votes.scene_feature == before.scene_feature);
  CHECK(votes.circle_votes() == 1);
  CHECK(votes.tx[0] == 0);
  CHECK(votes.size() == votes.tx.size());
  for (const std::uint32_t feature : votes.single_feature)
    CHECK(feature < scene.features.points.rows());
}

TEST_CASE("how many vote, and how often, is said", "[vote]") {
  const Scene scene;
  const VoteSet none = no_votes(model_with_pairs(1));
  CHECK(same(cast({none}, scene.features, scene.cloud, {{"references", "0"}})[0], none));
  CHECK(
      cast({none}, scene.features, scene.cloud, {{"references", "90"}, {"poses", "1"}})[0].size() <=
      90);
  CHECK(cast({none}, scene.features, scene.cloud,
             {{"references", "90"}, {"poses", "50"}, {"least_ratio", "0"}})[0]
            .size() > 180);
}

TEST_CASE("the same votes again, and whatever else is sought", "[vote]") {
  const Scene scene;
  const std::vector<VoteSet> sets{no_votes(model_with_pairs(1)), no_votes(model_with_pairs(2))};
  const auto together = cast(sets, scene.features, scene.cloud);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(same(together[i], cast(sets, scene.features, scene.cloud)[i]));
    CHECK(same(together[i], cast({sets[i]}, scene.features, scene.cloud)[0]));
  }
}

TEST_CASE("colours choose where pairs start", "[vote][color]") {
  Scene scene;
  const Cloud grey = scene.cloud;
  const Eigen::Isometry3d T = scene.bodies[0].T_scene_model;
  const Eigen::RowVector3f red(0.6F, 0.05F, 0.05F), blue(0.05F, 0.05F, 0.6F);
  scene.cloud.colors.resize(grey.points.rows(), 3);
  const float reach = 0.6F * bumpy_model(1)->diagonal;
  for (Eigen::Index i = 0; i < grey.points.rows(); ++i) {
    const Eigen::Vector3f offset = grey.points.row(i).transpose() - T.translation().cast<float>();
    scene.cloud.colors.row(i) = offset.norm() < reach ? red : blue;
  }
  const auto painted = model_with_pairs(1, red);
  const auto right = [&](const std::shared_ptr<const Model>& model, const Cloud& cloud) {
    return near(cast({no_votes(model)}, scene.features, cloud, {{"references", "60"}})[0], T);
  };
  const std::size_t by_shape = right(model_with_pairs(1), grey);
  CHECK(by_shape > 3);
  CHECK(right(painted, scene.cloud) > 2 * by_shape);
  CHECK(right(painted, grey) == by_shape);
}

TEST_CASE("what cannot be paired casts no votes and does no harm", "[vote]") {
  Scene scene;
  const VoteSet unindexed = no_votes(bumpy_model(1));
  CHECK(same(cast({unindexed}, scene.features, scene.cloud)[0], unindexed));
  CHECK(cast({}, scene.features, scene.cloud).size() == 0);
  const VoteSet good = no_votes(model_with_pairs(2));
  CHECK(cast({good}, FeatureSet{}, scene.cloud)[0].size() == 0);
  for (Eigen::Index i = 0; i < scene.features.points.rows(); i += 2) {
    scene.features.normals.row(i).setZero();
    scene.features.points(i, i % 3) = std::numeric_limits<float>::quiet_NaN();
  }
  for (Eigen::Index i = 0; i < scene.cloud.points.rows(); i += 3)
    scene.cloud.normals(i, i % 3) = std::numeric_limits<float>::infinity();
  const VoteSet votes =
      cast({unindexed, good}, scene.features, scene.cloud, {{"references", "3000"}})[1];
  CHECK(votes.size() > 100);
  for (std::size_t v = 0; v < votes.size(); ++v) {
    CHECK(std::isfinite(votes.tx[v] + votes.ty[v] + votes.tz[v]));
    CHECK(std::isfinite(votes.qw[v] + votes.qx[v] + votes.qy[v] + votes.qz[v]));
  }
}

}  // namespace posevote::cast_pairs_test
