// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/contest.hpp"

#include <catch2/catch.hpp>

#include "tests/support/box_cloud.hpp"

namespace posevote::contest_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

constexpr float kSpacing = 0.002F;

Cloud face(float width, float height) {
  std::vector<Eigen::RowVector3f> points, normals;
  add_rectangle(points, normals, {0, 0, 0}, {width, 0, 0}, {0, height, 0}, kSpacing);
  return geometry::cloud_of(points, normals);
}

Model model_of(float width, float height) {
  Model model;
  model.cloud = face(width, height);
  model.diagonal = std::hypot(width, height);
  return model;
}

/// A flat face in a scan, claimed as a whole, and one that is a part of it.
struct Contest {
  Cloud scan = face(0.1F, 0.08F);
  FeatureSet no_features;
  ScanState state{scan, no_features, kSpacing};
  Model all = model_of(0.1F, 0.08F), part = model_of(0.06F, 0.08F);

  /// Whether the whole goes before the part, at these confidences, the part moved by `aside` [m].
  bool whole_first(double of_all, double of_part, double aside = 0) const {
    return odds_of_whole(of_all, of_part, aside).value_or(-1) > 0;
  }

  std::optional<double> odds_of_whole(double of_all, double of_part, double aside = 0) const {
    Candidate whole, other;
    whole.confidence = of_all;
    other.confidence = of_part;
    other.T_scene_model.translation().x() = aside;
    constexpr float kTolerance = 2 * kSpacing;
    const geometry::SurfaceIndex whole_index(all.cloud.points, kTolerance),
        part_index(part.cloud.points, kTolerance);
    return log_odds_over({all, whole_index, whole, kTolerance},
                         {part, part_index, other, kTolerance}, state, {});
  }
};

}  // namespace

TEST_CASE("what explains much more of the same goes first, unless it is far less sure", "[poses]") {
  const Contest contest;  // 1.6 times the points, worth 2.9 in the odds, and two deviations
  CHECK(contest.whole_first(0.9, 0.9));
  CHECK(contest.whole_first(0.9, 0.98));
  CHECK_FALSE(contest.whole_first(0.3, 0.99));
}

TEST_CASE("poses that share little of the scan are no rivals", "[poses]") {
  const Contest contest;
  CHECK(contest.whole_first(0.9, 0.9, 0.03));
  CHECK_FALSE(contest.whole_first(0.9, 0.9, 0.2));  // nowhere near
}

TEST_CASE("of two that claim the same, the scan decides where only one has a surface", "[poses]") {
  Contest contest;
  contest.part = model_of(0.098F, 0.08F);
  const double alike = contest.odds_of_whole(0.9, 0.9).value();
  CHECK(std::abs(alike) < 0.3);  // nothing of either lies outside the other's tolerance
  contest.part = model_of(0.09F, 0.08F);
  const double seen = contest.odds_of_whole(0.9, 0.9).value();
  CHECK(seen > 2);  // the two deviations that count, and a little for the extent
  CHECK(contest.odds_of_whole(0.9, 0.99).value() == Approx(seen - 2.4).margin(0.1));
}

TEST_CASE("what was taken out of the scan is nobody's", "[poses]") {
  Contest contest;
  Candidate gone;
  contest.state.take_out(contest.part, gone.T_scene_model, 2 * kSpacing);
  CHECK_FALSE(contest.whole_first(0.9, 0.9));
}

}  // namespace posevote::contest_test
