// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/twins.hpp"

#include <catch2/catch.hpp>

#include "nodes/poses/confidence.hpp"
#include "nodes/poses/score.hpp"
#include "tests/nodes/poses/sought_body.hpp"
#include "tests/support/box_cloud.hpp"

namespace posevote::twins_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

/// The body proposed as its twin: `motion` carries it to where it is. What the scan's points say of
/// it (residual_lead_test.cpp) does not count.
struct Mistaken {
  SoughtBody body{{kBody}};
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  poses::Candidate wrong, right;
  std::vector<std::uint32_t> for_wrong, for_right;  // points that speak for one of them

  Mistaken() {
    body.params.refine = false;
    body.params.terms.twins.err_alike = 1e18;
    motion.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
    wrong = body.candidate(kBody.T_scene_model * motion.inverse());
    right = body.candidate(kBody.T_scene_model);
    for (poses::Candidate* one : {&wrong, &right}) poses::judge(body.sought(), *one, {1000});
    for (std::uint32_t i = 0; i < body.model.cloud.points.rows(); ++i) {
      if (balance_of(i, wrong) > 0) for_wrong.push_back(i);
      if (balance_of(i, right) > 0) for_right.push_back(i);
    }
  }
  double balance_of(std::uint32_t point, const poses::Candidate& one) const {
    return poses::weigh_points(body.model.cloud, {point}, body.scan.surface, body.scan.view,
                               one.T_scene_model, 2 * kResolution)
        .balance;
  }
  void differ(const std::vector<std::uint32_t>& carried_off,
              const std::vector<std::uint32_t>& uncovered) {
    body.model.near_symmetries = {{{motion, carried_off, uncovered}}};
  }
  poses::Candidate chosen() const {
    const poses::TakenPlaces none(0);
    return poses::best_alike(body.sought(), wrong, none);
  }
  bool chooses_right() const { return chosen().T_scene_model.isApprox(right.T_scene_model, 1e-9); }
};

}  // namespace

TEST_CASE("the lead counts what differs, in standard deviations", "[poses]") {
  Mistaken setting;
  setting.differ(setting.for_right, {});
  const double lead = poses::lead_over(setting.body.sought(), setting.wrong, setting.right);
  CHECK(lead == Approx(std::sqrt(double(setting.for_right.size()))));
  setting.differ({}, setting.for_wrong);
  const double behind = poses::lead_over(setting.body.sought(), setting.wrong, setting.right);
  CHECK(behind == Approx(-std::sqrt(double(setting.for_wrong.size()))));
  setting.differ({}, {});
  CHECK(poses::lead_over(setting.body.sought(), setting.wrong, setting.right) == 0);
}

TEST_CASE("of twins, the points where they differ and the confidences decide", "[poses]") {
  Mistaken setting;
  CHECK_FALSE(setting.chooses_right());  // that it has a twin is not known
  setting.differ({}, {});
  CHECK(setting.chooses_right());
  setting.wrong.confidence = 1;
  CHECK_FALSE(setting.chooses_right());
  setting.wrong.confidence = 0.5;
  CHECK(setting.chooses_right());
  poses::TwinTerms& terms = setting.body.params.terms.twins;
  terms.lead_odds = 10;
  setting.differ({}, setting.for_wrong);
  CHECK_FALSE(setting.chooses_right());
  terms.telling = 0;  // nothing tells
  CHECK_FALSE(setting.chooses_right());
}

TEST_CASE("what twins were judged by counts up to what tells", "[poses]") {
  Mistaken setting;
  setting.differ({}, {});
  setting.wrong.confidence = 0;
  const double own = poses::log_odds_of(setting.chosen().confidence);
  setting.wrong.confidence = poses::probability_of(own + 4);
  CHECK_FALSE(setting.chooses_right());
  setting.body.params.terms.twins.err_alike = 4;
  setting.differ(setting.for_right, {});
  REQUIRE(setting.chooses_right());
  // That the body is there was as probable, but for what does not count.
  CHECK(poses::log_odds_of(setting.chosen().confidence) == Approx(own + 2).epsilon(1e-6));
  setting.wrong.confidence = poses::probability_of(own + 1);
  CHECK(poses::log_odds_of(setting.chosen().confidence) == Approx(own + 1).epsilon(1e-6));
  setting.wrong.confidence = poses::probability_of(own - 1);
  CHECK(poses::log_odds_of(setting.chosen().confidence) == Approx(own).epsilon(1e-6));
}

TEST_CASE("the scan's points decide, too, where twins differ", "[poses]") {
  Mistaken setting;
  setting.differ({}, {});
  setting.wrong.confidence = 0;
  REQUIRE(setting.chooses_right());
  setting.wrong.confidence =
      poses::probability_of(1 + poses::log_odds_of(setting.chosen().confidence));
  CHECK_FALSE(setting.chooses_right());
  CHECK(poses::look_alikes(setting.body.sought(), setting.wrong).size() == 1);
  setting.body.params.terms.twins.err_alike = 4;
  CHECK(setting.chooses_right());
  CHECK(poses::look_alikes(setting.body.sought(), setting.right).empty());
  setting.body.params.terms.twins.telling = 0.5;  // too little against a deviation of confidence
  CHECK_FALSE(setting.chooses_right());
}

TEST_CASE("of two look-alikes one does not reach into the ground on which the other stands",
          "[poses]") {
  Mistaken setting;
  setting.differ({}, {});
  setting.wrong.confidence = 0;
  setting.wrong.confidence =
      poses::probability_of(1 + poses::log_odds_of(setting.chosen().confidence));
  CHECK_FALSE(setting.chooses_right());
  Mistaken mirrored;
  mirrored.motion = setting.motion.inverse();
  mirrored.differ({}, {});
  REQUIRE(poses::look_alikes(mirrored.body.sought(), mirrored.right).size() == 1);
  // A plane on whose one side the body lies as it is, but not as its twin.
  const auto lowest = [&](const poses::Candidate& one) {
    const Eigen::Isometry3f T = one.T_scene_model.cast<float>();
    return (T * setting.body.model.outline.hull).row(1).minCoeff();
  };
  std::vector<Eigen::RowVector3f> points, normals;
  test::add_rectangle(points, normals, {0, lowest(setting.right), 0.8F}, {0, 0, 1}, {1, 0, 0},
                      kResolution);
  const Cloud plane = geometry::cloud_of(points, normals);
  const float depth = 0.25F * (lowest(setting.right) - lowest(setting.wrong));
  REQUIRE(depth > 0);
  for (Mistaken* one : {&setting, &mirrored}) one->body.scan.ground = poses::Ground(plane, depth);
  CHECK(setting.chooses_right());
  const auto others = poses::look_alikes(mirrored.body.sought(), mirrored.right);
  REQUIRE(others.size() == 1);
  CHECK(others[0].probability == Approx(1 / (1 + std::exp(3.0))).epsilon(0.1));
}

TEST_CASE("a twin whose place is taken does not compete", "[poses]") {
  Mistaken setting;
  setting.differ(setting.for_right, {});
  const Eigen::Isometry3d there = setting.right.T_scene_model;
  setting.body.model.center = Eigen::Vector3f(0, 0.1F, 0);  // turning moves it
  poses::TakenPlaces taken(0.02F);
  taken.take(setting.body.model, setting.body.candidate(there));
  const poses::Candidate best = poses::best_alike(setting.body.sought(), setting.wrong, taken);
  CHECK(best.T_scene_model.matrix() == setting.wrong.T_scene_model.matrix());
}

TEST_CASE("look-alikes are the poses that nothing seen tells from the one found", "[poses]") {
  Mistaken setting;
  const auto others = [&](const poses::Candidate& found) {
    return poses::look_alikes(setting.body.sought(), found);
  };
  CHECK(others(setting.wrong).empty());  // no near symmetry is known
  setting.differ({}, {});
  const std::vector<LookAlike> one = others(setting.wrong);
  REQUIRE(one.size() == 1);
  CHECK(one[0].probability == Approx(0.5));
  CHECK((setting.wrong.T_scene_model * one[0].motion).isApprox(setting.right.T_scene_model, 1e-9));
  // Two points more on one of them, in standard deviations.
  setting.differ({}, {setting.for_wrong[0], setting.for_wrong[1]});
  const double odds = std::exp(-std::sqrt(2.0));
  REQUIRE(others(setting.wrong).size() == 1);
  CHECK(others(setting.wrong)[0].probability == Approx(odds / (1 + odds)));
  setting.differ({}, setting.for_wrong);  // plain to see
  CHECK(others(setting.wrong).empty());
}

TEST_CASE("several look-alikes share what is probable; a symmetry is none", "[poses]") {
  Mistaken setting;
  setting.differ({}, {});
  Model& model = setting.body.model;
  NearSymmetry back = model.near_symmetries.items[0];
  back.motion = back.motion.inverse();
  back.uncovered = {setting.for_wrong[0]};
  model.near_symmetries.items.push_back(back);
  const auto others = poses::look_alikes(setting.body.sought(), setting.wrong);
  REQUIRE(others.size() == 2);
  CHECK(others[0].probability > others[1].probability);
  CHECK(others[1].probability / others[0].probability == Approx(std::exp(-1.0)));
  CHECK(others[0].probability == Approx(1 / (2 + std::exp(-1.0))));
  model.symmetries.turns.emplace_back(Eigen::Quaterniond(setting.motion.linear()).cast<float>());
  REQUIRE(poses::look_alikes(setting.body.sought(), setting.wrong).size() == 1);
  model.symmetries.axes = {Eigen::Vector3f::UnitX()};
  CHECK(poses::look_alikes(setting.body.sought(), setting.wrong).empty());
}

}  // namespace posevote::twins_test
