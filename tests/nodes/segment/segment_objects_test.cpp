// SPDX-License-Identifier: BSD-3-Clause
// What segment_objects finds, and how it says so.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/nodes/segment/segment_inputs.hpp"

namespace posevote::segment_objects_test {

using namespace posevote::test;

namespace {

const test::Values kNoStrangers{{"kinds", "1"}};

}  // namespace

TEST_CASE("two objects are found at their poses", "[segment]") {
  const std::vector<Detection> found = test::segment(inputs_of({kLeft, kRight}, {1, 2}));
  REQUIRE(found.size() == 2);
  for (const Detection& d : found) {
    const Placed& truth = d.obj_id == 1 ? kLeft : kRight;
    INFO(d.model << " score " << d.score << " density " << d.density << " runner-up "
                 << d.runner_up_density << " inliers " << d.inlier_fraction << " rmse " << d.rmse);
    CHECK(shift_between(d.T_scene_model, truth.T_scene_model) < 0.1 * kResolution);
    CHECK(turn_between(d.T_scene_model, truth.T_scene_model) < 0.005);
    CHECK(d.score > 0.8);
    CHECK(d.density > 3 * d.runner_up_density);
    CHECK(d.inlier_fraction > 0.85);
    CHECK(d.rmse < 0.1 * kResolution);
  }
}

TEST_CASE("a pose that few features voted for scores lower", "[segment]") {
  const std::vector<Detection> all = test::segment(inputs_of({kLeft}, {1}, 0));
  const SegmentInputs sparse = inputs_of({kLeft}, {1}, 0.97);
  const std::vector<Detection> few = test::segment(sparse, kNoStrangers);
  REQUIRE(all.size() == 1);
  REQUIRE(few.size() == 1);
  CHECK(shift_between(few[0].T_scene_model, all[0].T_scene_model) < 0.1 * kResolution);
  CHECK(few[0].density < 0.1 * all[0].density);
  CHECK(few[0].inlier_fraction == Approx(all[0].inlier_fraction).margin(0.01));
  CHECK(few[0].score < 0.8 * all[0].score);
  CHECK(test::segment(sparse, {{"min_score", std::to_string(1.01 * few[0].score)}}).empty());
}

TEST_CASE("of few kinds that are looked for each is believed less, and found at the same pose",
          "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2});
  const std::vector<Detection> among = test::segment(inputs, kNoStrangers),
                               alone = test::segment(inputs);
  REQUIRE(among.size() == 2);
  REQUIRE(alone.size() == 2);
  std::vector<double> strangers;
  for (const Detection& one : alone) {
    const auto same = std::find_if(among.begin(), among.end(), [&](const Detection& other) {
      return other.obj_id == one.obj_id;
    });
    REQUIRE(same != among.end());
    CHECK(one.T_scene_model.matrix() == same->T_scene_model.matrix());
    CHECK(one.confidence < same->confidence);
    CHECK(same->clues[kStrangers] == 0);
    CHECK(one.against[kStrangers] == Approx(-one.clues[kStrangers]));
    strangers.push_back(one.clues[kStrangers]);
  }
  std::sort(strangers.begin(), strangers.end());
  CHECK(strangers[0] == Approx(std::log(2.0 / 20)));
  CHECK(strangers[1] == Approx(std::log((2.0 + 2) / 20)));  // one was found before
}

TEST_CASE("two instances of one object are both found", "[segment]") {
  const Placed left{1, pose(-0.09, 0.01, 0.8, 0.7)}, right{1, pose(0.09, -0.02, 0.75, 2.5)};
  const SegmentInputs inputs = inputs_of({left, right}, {1});
  CHECK(test::segment(inputs, {{"max_instances", "1"}, {"kinds", "1"}}).size() == 1);
  const std::vector<Detection> found = test::segment(inputs, kNoStrangers);
  REQUIRE(found.size() == 2);
  for (const Placed& truth : {left, right}) {
    const auto error = [&truth](const Detection& d) {
      return shift_between(d.T_scene_model, truth.T_scene_model);
    };
    CHECK(std::min(error(found[0]), error(found[1])) < 0.1 * kResolution);
  }
  CHECK(found[0].runner_up_density > 0.5 * found[0].density);  // the other instance
}

TEST_CASE("an object that is not there is not found", "[segment]") {
  const std::vector<Detection> found =
      test::segment(inputs_of({kLeft}, {1, 3}), {{"max_instances", "3"}});
  REQUIRE(found.size() == 1);
  CHECK(found.front().obj_id == 1);
}

TEST_CASE("a scan fully explained leaves nothing for later objects", "[segment]") {
  SegmentInputs inputs;
  inputs.scan = scan_of({kLeft}, false);
  inputs.features = features_of(inputs.scan);
  const Correspondences matches = match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.3);
  add_object(inputs, matches);
  add_object(inputs, matches);
  CHECK(test::segment(inputs, {{"max_instances", "3"}, {"min_score", "0"}}).size() == 1);
}

TEST_CASE("without votes there are no detections", "[segment]") {
  SegmentInputs inputs;
  inputs.scan = scan_of({kLeft});
  inputs.features = features_of(inputs.scan);
  CHECK(test::segment(inputs).empty());
  Correspondences none;
  none.model = bumpy_model(2);
  add_object(inputs, none);
  CHECK(test::segment(inputs).empty());
  add_object(inputs, match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.5));
  CHECK(test::segment(inputs).size() == 1);
}

TEST_CASE("votes on an empty or unoriented scan find nothing", "[segment]") {
  SegmentInputs inputs = inputs_of({kLeft}, {1});
  inputs.scan.normals.setZero();
  CHECK(test::segment(inputs).empty());
  inputs.scan = Cloud{};
  CHECK(test::segment(inputs).empty());
}

TEST_CASE("the object that fits best comes first, whatever votes for another", "[segment]") {
  SegmentInputs inputs = inputs_of({kLeft}, {});
  auto decoy = std::make_shared<Model>(*bumpy_model(1));  // alike on one half
  decoy->obj_id = 0;
  for (Eigen::Index i = 0; i < decoy->cloud.points.rows(); ++i)
    if (decoy->cloud.points(i, 0) > decoy->center.x())
      decoy->cloud.points.row(i) += 0.02F * decoy->cloud.normals.row(i);
  Correspondences for_decoy = match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.1);
  for_decoy.model = decoy;
  add_object(inputs, for_decoy);
  const Values any = {{"min_confidence", "0"}};
  CHECK(test::segment(inputs, any).size() == 1);  // it would be found
  add_object(inputs, match_truly(bumpy_model(1), inputs.features, {kLeft}, 0.8));
  const std::vector<Detection> found = test::segment(inputs, any);
  REQUIRE(found.size() == 1);
  CHECK(found.front().obj_id == 1);
  CHECK(shift_between(found.front().T_scene_model, kLeft.T_scene_model) < 0.1 * kResolution);
}

TEST_CASE("numbers are finite and in range even where all matches are wrong", "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2, 4}, 1.0);
  const Values values{{"max_instances", "2"}, {"candidates", "10"}, {"min_score", "0"}};
  for (const Detection& d : test::segment(inputs, values)) {
    CHECK(d.T_scene_model.matrix().allFinite());
    CHECK(d.T_scene_model.linear().determinant() == Approx(1));
    CHECK((d.score >= 0 && d.score <= 1));
    CHECK((d.inlier_fraction >= 0 && d.inlier_fraction <= 1));
    CHECK(std::isfinite(d.rmse));
    CHECK(std::isfinite(d.density));
  }
}

TEST_CASE("ICP can be switched off, and then the mode itself is the pose", "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft}, {1}, 0.2);
  const std::vector<Detection> rough = test::segment(inputs, {{"refine", "false"}});
  const std::vector<Detection> fine = test::segment(inputs);
  REQUIRE(rough.size() == 1);
  REQUIRE(fine.size() == 1);
  CHECK(shift_between(rough[0].T_scene_model, kLeft.T_scene_model) < 2 * kResolution);
  CHECK(turn_between(rough[0].T_scene_model, kLeft.T_scene_model) < 0.06);
  CHECK(rough[0].rmse > fine[0].rmse);
  CHECK(rough[0].density == fine[0].density);
}

TEST_CASE("what scores too low is rejected", "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft}, {1});
  REQUIRE(test::segment(inputs).size() == 1);
  const Detections none = segment_all(inputs, {{"min_score", "1"}});
  CHECK(none.items.empty());
  REQUIRE(!none.rejected.empty());
  CHECK(none.rejected[0].why.find("is below min_score 1.00") != std::string::npos);
}

TEST_CASE("the best poses of what is not found are told, with what speaks against them",
          "[segment]") {
  const SegmentInputs inputs = inputs_of({kLeft}, {1, 3});
  const Detections found = segment_all(inputs);
  REQUIRE(found.items.size() == 1);
  std::size_t of_absent = 0;
  for (const Detection& rejected : found.rejected) {
    CHECK(rejected.confidence < 0.5);
    CHECK(rejected.why.find("is below min_") != std::string::npos);
    if (rejected.obj_id != 3) continue;
    ++of_absent;
    double against = 0;
    for (const double clue : rejected.against) against += clue;
    CHECK(against > 2);  // log odds
  }
  CHECK(of_absent >= 1);
  CHECK(of_absent <= 3);
  for (std::size_t i = 1; i < found.rejected.size(); ++i)
    CHECK(found.rejected[i - 1].confidence >= found.rejected[i].confidence);
}

TEST_CASE("lengths and normals that cannot be are refused", "[segment]") {
  SegmentInputs inputs;
  inputs.scan = scan_of({kLeft});
  inputs.features = features_of(inputs.scan);
  for (const float resolution : {0.0F, -1.0F, std::nanf(""), HUGE_VALF})
    CHECK_THROWS_WITH(run_node<Detections>("segment_objects", {}, inputs.votes, inputs.densities,
                                           inputs.features, inputs.scan, Scale{resolution}),
                      Catch::Contains("resolution"));
  inputs.scan.normals.resize(0, 3);
  CHECK_THROWS_WITH(test::segment(inputs), Catch::Contains("the scan has"));
  inputs.scan = scan_of({kLeft});
  inputs.features.normals.resize(1, 3);
  CHECK_THROWS_WITH(test::segment(inputs), Catch::Contains("the feature set has"));
}

}  // namespace posevote::segment_objects_test
