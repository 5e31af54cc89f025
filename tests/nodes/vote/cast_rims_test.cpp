// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>
#include <tuple>

#include "nodes/data/votes.hpp"
#include "nodes/pairs/pair_table.hpp"
#include "tests/support/box_cloud.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::cast_rims_test {

using namespace posevote::test;

namespace {

using Cast = std::tuple<PerObject<VoteSet>, FeatureSet>;

constexpr float kSpacing = 0.002F;
const Eigen::Vector3f kSize(0.04F, 0.08F, 0.12F);

VoteSet no_votes(const Eigen::Vector3f& size, bool with_rims = true) {
  auto model = std::make_shared<Model>();
  model->cloud = box_cloud(size, kSpacing);
  model->resolution = kSpacing;
  model->diagonal = size.norm();
  if (with_rims) model->rims = pairs::index_rims(*model, 0.025F * model->diagonal);
  VoteSet votes;
  votes.model = model;
  votes.votes_per_correspondence = 60;
  return votes;
}

/// The front of the box, 0.8 m before the sensor and turned about its normal, on a table behind it.
struct Scene {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Cloud cloud;
  FeatureSet features;

  /// `cover`: a screen before the part of the box beyond that x [m].
  explicit Scene(float cover = 1) {
    T_scene_model.translation() << 0.02, -0.01, 0.8;
    T_scene_model.linear() = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    std::vector<Eigen::RowVector3f> points, normals;
    const auto add = [&](const Eigen::Vector3f& center, float width, float height, float turn) {
      const Eigen::Matrix3f R = Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitZ()).matrix();
      add_rectangle(points, normals, center, R * Eigen::Vector3f(0, height, 0),
                    R * Eigen::Vector3f(width, 0, 0), kSpacing);  // toward the sensor
    };
    const float front_z = 0.8F - kSize.z() / 2;
    add({0.02F, -0.01F, front_z}, kSize.x(), kSize.y(), 0.6F);
    const Eigen::Isometry3f T = T_scene_model.cast<float>();
    std::vector<Eigen::RowVector3f> front = points, front_normals = normals;
    points.clear();
    normals.clear();
    for (std::size_t i = 0; i < front.size(); ++i)
      if (front[i].x() < cover) {
        points.push_back(front[i]);
        normals.push_back(front_normals[i]);
      }
    if (cover < 1) add({cover + 0.05F, 0, 0.6F}, 0.1F, 0.3F, 0);
    const std::size_t table = points.size();
    add({0, 0, 0.86F}, 0.4F, 0.4F, 0);
    for (std::size_t i = points.size(); i-- > table;) {  // what the box hides of it
      const Eigen::Vector3f on_front = points[i].transpose() * front_z / 0.86F;
      const Eigen::Vector3f p = T.inverse() * on_front;
      if (std::abs(p.x()) < kSize.x() / 2 && std::abs(p.y()) < kSize.y() / 2) {
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
        normals.erase(normals.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    cloud = geometry::cloud_of(points, normals);
    features = features_of(cloud, 50);
  }
};

Cast cast(const std::vector<VoteSet>& sets, const FeatureSet& features, const Cloud& cloud,
          const std::map<std::string, std::string>& params = {}) {
  PerObject<VoteSet> all;
  for (const VoteSet& votes : sets) all.slots.push_back(std::make_shared<const VoteSet>(votes));
  const auto out = run_outputs("cast_rims", params, all, features, cloud, Scale{kSpacing});
  return {graph::StreamTraits<PerObject<VoteSet>>::unwrap(out.at(0)),
          graph::StreamTraits<FeatureSet>::unwrap(out.at(1))};
}

/// The votes within 5 mm and 10 deg of a pose, or of one that looks alike: half turns of a box.
std::size_t near(const VoteSet& votes, const Eigen::Isometry3d& T_scene_model) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < votes.tx.size(); ++v) {
    const Eigen::Vector3f center(votes.tx[v], votes.ty[v], votes.tz[v]);
    const Eigen::Quaternionf q(votes.qw[v], votes.qx[v], votes.qy[v], votes.qz[v]);
    const Eigen::Matrix3f turn =
        T_scene_model.linear().cast<float>().transpose() * q.toRotationMatrix();
    if ((center - T_scene_model.translation().cast<float>()).norm() < 0.005F &&
        turn.diagonal().cwiseAbs().minCoeff() > 0.985F)
      ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("the outline of a flat side votes for where a box is", "[vote]") {
  const Scene scene;
  const auto [votes, vote_points] = cast({no_votes(kSize)}, scene.features, scene.cloud);
  REQUIRE(votes[0].size() > 100);
  CHECK(near(votes[0], scene.T_scene_model) > votes[0].size() / 10);
  Eigen::Isometry3d turned = scene.T_scene_model;
  turned.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  CHECK(near(votes[0], turned) == 0);
}

TEST_CASE("where something hides how a face goes on it does not end", "[vote]") {
  const Scene covered(0.025F);
  const auto [votes, vote_points] = cast({no_votes(kSize)}, covered.features, covered.cloud);
  std::size_t at_screen = 0;
  for (Eigen::Index i = covered.features.points.rows(); i < vote_points.points.rows(); ++i) {
    const Eigen::RowVector3f p = vote_points.points.row(i);
    const bool is_box = std::abs(p.z() - 0.74F) < 0.01F;
    at_screen += is_box && std::abs(p.x() - 0.025F) < 0.5F * kSpacing && std::abs(p.y()) < 0.01F;
  }
  CHECK(at_screen == 0);
  CHECK(near(votes[0], covered.T_scene_model) > 0);  // its other ends still tell
}

TEST_CASE("ends stand behind the features that votes come from", "[vote]") {
  const Scene scene;
  const auto [votes, vote_points] = cast({no_votes(kSize)}, scene.features, scene.cloud);
  const Eigen::Index features = scene.features.points.rows();
  CHECK(vote_points.points.topRows(features) == scene.features.points);
  CHECK(vote_points.normals.rows() == vote_points.points.rows());
  REQUIRE(octaves_of(vote_points).size() == 1);  // scores count features alone
  CHECK(octaves_of(vote_points)[0].end == features);
  for (const std::uint32_t row : votes[0].single_feature) {
    CHECK(row >= features);
    CHECK(row < vote_points.points.rows());
  }
}

TEST_CASE("how many ends vote, and how often, is said", "[vote]") {
  const Scene scene;
  const auto count = [&](const std::map<std::string, std::string>& params) {
    return std::get<0>(cast({no_votes(kSize)}, scene.features, scene.cloud, params))[0].size();
  };
  CHECK(count({{"references", "0"}}) == 0);
  CHECK(count({{"references", "30"}, {"poses", "1"}}) <= 30);
  CHECK(count({{"references", "30"}, {"poses", "20"}, {"least_ratio", "0"}}) > 200);
}

TEST_CASE("the same votes of ends again, and whatever else is sought", "[vote]") {
  const Scene scene;
  const std::vector<VoteSet> sets{no_votes(kSize), no_votes({0.02F, 0.03F, 0.05F})};
  const auto together = std::get<0>(cast(sets, scene.features, scene.cloud));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto alone = std::get<0>(cast({sets[i]}, scene.features, scene.cloud));
    CHECK(together[i].tx == alone[0].tx);
    CHECK(together[i].qw == alone[0].qw);
  }
}

TEST_CASE("what has no ends casts no votes of them and does no harm", "[vote]") {
  Scene scene;
  const VoteSet plain = no_votes(kSize, false);
  CHECK(std::get<0>(cast({plain}, scene.features, scene.cloud))[0].size() == 0);
  CHECK(std::get<0>(cast({}, scene.features, scene.cloud)).size() == 0);
  CHECK(std::get<0>(cast({no_votes(kSize)}, {}, {}))[0].size() == 0);
  for (Eigen::Index i = 0; i + 1 < scene.cloud.points.rows(); i += 7) {
    scene.cloud.normals(i, i % 3) = std::numeric_limits<float>::infinity();
    scene.cloud.points(i + 1, i % 3) = std::numeric_limits<float>::quiet_NaN();
  }
  const VoteSet votes = std::get<0>(cast({no_votes(kSize)}, scene.features, scene.cloud))[0];
  CHECK(votes.size() > 50);
  for (std::size_t v = 0; v < votes.size(); ++v)
    CHECK(std::isfinite(votes.tx[v] + votes.ty[v] + votes.tz[v] + votes.qw[v] + votes.qx[v]));
}

}  // namespace posevote::cast_rims_test
