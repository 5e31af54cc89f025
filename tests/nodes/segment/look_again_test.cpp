// SPDX-License-Identifier: BSD-3-Clause
// From frame to frame: what was found is looked for where it was, and only what is new is sought.
#include <catch2/catch.hpp>
#include <random>

#include "graph/previous.hpp"
#include "nodes/poses/sightings.hpp"
#include "tests/nodes/segment/segment_inputs.hpp"

namespace posevote::look_again_test {

using namespace posevote::test;
using poses::Sightings;

namespace {

Placed moved(const Placed& body, double x) {
  Placed there = body;
  there.T_scene_model.translation().x() += x;
  return there;
}

struct Answer {
  Detections detections;
  Sightings sightings;
};

Answer search(const SegmentInputs& in, const Sightings& seen, const Values& values = {}) {
  const std::vector<graph::Value> outputs =
      run_outputs("segment_new_objects", values, in.votes, in.densities, in.features, in.scan,
                  Scale{kResolution}, Sightings(seen));
  return {*std::static_pointer_cast<const Detections>(outputs[0]),
          *std::static_pointer_cast<const Sightings>(outputs[1])};
}

struct Seen {
  Sightings now;
  FeaturePoints left;
};

/// All points of the scan would be described.
Seen look(const Cloud& scan, const Sightings& before, const Values& values = {}) {
  ModelLibrary library;
  library.models = {bumpy_model(1), bumpy_model(2)};
  FeaturePoints points;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    points.indices.push_back(static_cast<std::uint32_t>(i));
  const auto one = [](auto value) {
    return std::make_shared<const decltype(value)>(std::move(value));
  };
  const std::vector<graph::Value> outputs = run_outputs(
      "look_again", values, PerObject<Cloud>{{one(scan)}}, PerObject<FeaturePoints>{{one(points)}},
      Scale{kResolution}, library, graph::Previous<Sightings>{one(before)});
  return {*std::static_pointer_cast<const Sightings>(outputs[0]),
          graph::StreamTraits<PerObject<FeaturePoints>>::unwrap(outputs[1])[0]};
}

const Values kOne{{"max_instances", "1"}};

Cloud noisy_scan(unsigned seed) {
  Cloud scan = scan_of({kLeft, kRight});
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 0.0005F);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) scan.points(i, 2) += noise(random);
  return scan;
}

/// Deviation of the first instance's place from its mean over frames that differ by noise alone [m].
double jitter(const Values& values) {
  Sightings sightings = search(inputs_of({kLeft, kRight}, {1, 2}), {}, kOne).sightings;
  std::vector<Eigen::Vector3d> places;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (unsigned frame = 0; frame < 24; ++frame) {
    sightings = look(noisy_scan(frame), sightings, values).now;
    REQUIRE(sightings.items.size() == 2);
    if (frame < 8) continue;
    for (const poses::Sighting& one : sightings.items)
      if (one.object == 0) places.push_back(one.candidate.T_scene_model.translation());
    mean += places.back() / 16;
  }
  double squared = 0;
  for (const Eigen::Vector3d& place : places) squared += (place - mean).squaredNorm();
  return std::sqrt(squared / static_cast<double>(places.size()));
}

}  // namespace

TEST_CASE("the first frame of a stream is searched like any scan", "[look_again]") {
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2});
  const Answer first = search(inputs, {});
  const std::vector<Detection> single = test::segment(inputs);
  REQUIRE(first.detections.items.size() == single.size());
  for (std::size_t i = 0; i < single.size(); ++i) {
    CHECK(first.detections.items[i].T_scene_model.matrix() == single[i].T_scene_model.matrix());
    CHECK(first.detections.items[i].confidence == single[i].confidence);
    CHECK(first.sightings.items[i].density == single[i].density);
  }
}

TEST_CASE("what is still there follows its motion without a search", "[look_again]") {
  const Sightings before = search(inputs_of({kLeft, kRight}, {1, 2}), {}).sightings;
  const Placed left = moved(kLeft, 0.004), right = moved(kRight, -0.003);
  const Seen seen = look(scan_of({left, right}), before);
  CHECK_FALSE(seen.now.is_searched);
  CHECK(seen.now.frames_since_search == 1);
  CHECK(seen.left.indices.empty());
  REQUIRE(seen.now.items.size() == 2);
  for (const poses::Sighting& one : seen.now.items)
    CHECK(shift_between(one.candidate.T_scene_model,
                        (one.object == 0 ? left : right).T_scene_model) < 0.1 * kResolution);
}

TEST_CASE("what is lost is sought in the same frame, beside what is known", "[look_again]") {
  const Sightings before = search(inputs_of({kLeft, kRight}, {1, 2}), {}).sightings;
  const Placed far = moved(kRight, -0.12);
  SegmentInputs inputs = inputs_of({far}, {1, 2});
  Seen seen = look(inputs.scan, before);
  CHECK(seen.now.items.empty());
  CHECK(seen.now.is_searched);
  CHECK(seen.left.indices.size() == static_cast<std::size_t>(inputs.scan.points.rows()));
  const Answer again = search(inputs, seen.now);
  REQUIRE(again.detections.items.size() == 1);
  CHECK(again.detections.items[0].obj_id == 2);
  CHECK(shift_between(again.detections.items[0].T_scene_model, far.T_scene_model) <
        0.1 * kResolution);
}

TEST_CASE("a new object is found in the frame that is searched, on what is left", "[look_again]") {
  const Sightings before = search(inputs_of({kLeft}, {1, 2}), {}).sightings;
  REQUIRE(before.items.size() == 1);
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2});
  CHECK_FALSE(look(inputs.scan, before, {{"search_every", "2"}}).now.is_searched);
  const Seen seen = look(inputs.scan, before, {{"search_every", "1"}});
  REQUIRE(seen.now.is_searched);
  REQUIRE(seen.now.items.size() == 1);
  CHECK_FALSE(seen.left.indices.empty());
  for (const std::uint32_t i : seen.left.indices)
    CHECK((inputs.scan.points.row(i).transpose() - kLeft.T_scene_model.translation().cast<float>())
              .norm() > 0.03F);
  const Answer answer = search(inputs, seen.now);
  REQUIRE(answer.detections.items.size() == 2);
  CHECK(answer.detections.items[0].obj_id != answer.detections.items[1].obj_id);
  CHECK(answer.sightings.items.size() == 2);
}

TEST_CASE("where nothing more can be found, nothing is sought", "[look_again]") {
  const SegmentInputs inputs = inputs_of({kLeft, kRight}, {1, 2});
  const Sightings all = search(inputs, {}, kOne).sightings;
  CHECK_FALSE(look(inputs.scan, all, {{"search_every", "1"}}).now.is_searched);
  const Sightings some = search(inputs, {}).sightings;
  CHECK(look(inputs.scan, some, {{"search_every", "1"}}).now.is_searched);
}

TEST_CASE("where nothing was found, each frame is searched", "[look_again]") {
  CHECK(look(scan_of({kLeft}), Sightings()).now.is_searched);
}

TEST_CASE("an instance keeps its place to itself", "[look_again]") {
  Sightings before = search(inputs_of({kLeft}, {1}), {}).sightings;
  before.items.push_back(before.items[0]);
  const Seen seen = look(scan_of({kLeft}), before);
  CHECK(seen.now.items.size() == 1);
  CHECK(seen.now.is_searched);
}

TEST_CASE("what stands still jitters by less than half", "[look_again]") {
  CHECK(jitter({}) < 0.5 * jitter({{"drift", "1000"}}));
}

}  // namespace posevote::look_again_test
