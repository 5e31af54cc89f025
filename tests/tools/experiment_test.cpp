// SPDX-License-Identifier: BSD-3-Clause
// What experiments make of results: tables over conditions. Running them: tests/pipelines.
#include "tools/experiment/experiment.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tools/experiment/conditions.hpp"
#include "tools/experiment/protocol.hpp"
#include "tools/simulate/spec.hpp"

namespace posevote::experiment_test {

using Catch::Contains;
using posevote::test::TemporaryFolder;

namespace {

/// One object, two images at 1 m, one at 2 m, one whose noise is its sensor's own.
constexpr const char* kSpec = R"(models: [{shape: carton}]
scenes:
  - {count: 2, noise: 0.001, distance: 1, objects: [1]}
  - {noise: 0.002, distance: 2, objects: [1]}
  - {distance: 2, objects: [1]}
)";

layouts::GroundTruth truth_of_four_images() {
  layouts::GroundTruth truth;
  layouts::TrueObject& object = truth.objects[1];
  object.points.resize(2, 3);
  object.points << 0, 0, 0, 0, 0, 0.1F;
  object.diameter = 0.1;
  object.symmetries = {Eigen::Isometry3d::Identity()};
  for (int im_id = 0; im_id < 4; ++im_id) {
    truth.images[{1, im_id}] = {};
    truth.instances.push_back({1, im_id, 1, Eigen::Isometry3d::Identity(), {}});
  }
  return truth;
}

FoundInstance found(int im_id, double off) {
  FoundInstance row;
  row.scene_id = 1, row.im_id = im_id, row.obj_id = 1, row.score = 0.9;
  row.T_scene_model.translation().x() = off;
  return row;
}

}  // namespace

TEST_CASE("results by what a spec varies", "[experiment]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write("spec.yaml", kSpec);
  EvaluateOptions options;
  options.rules = "add";
  const CountsByConditions counts = split_by_conditions(
      truth_of_four_images(), {found(0, 0), found(0, 0.05), found(1, 0.05), found(2, 0)}, options,
      spec, 1);
  REQUIRE(counts.size() == 2);
  CHECK(counts.at({1, 0.001}).instances == 2);
  CHECK(counts.at({1, 0.001}).recall() == 0.5);
  CHECK(counts.at({1, 0.001}).detections == 3);
  CHECK(counts.at({2, 0.002}).recall() == 1);
  const std::string text = to_markdown({{"ours", counts}});
  CHECK_THAT(text, Contains("| ours, recall at noise of | 1 mm | 2 mm |\n|---|---|---|\n"
                            "| 1 m | 0.500 | - |\n| 2 m | - | 1.000 |\n"));
  CHECK_THAT(text, Contains("| 1 m | 0.333 | - |"));
  const auto rows = to_json({{"ours", counts}});
  CHECK(
      to_csv(rows).starts_with("method,distance_m,noise_mm,instances,detections,correct,recall,"
                               "precision\nours,1.0,1.0,2,3,1.0,0.5,0.3333"));
  CHECK_THAT(conditions_svg({{"ours", counts}}), Contains("</svg>"));
  // Of every second image there are two: the first, and the one at 2 m.
  const CountsByConditions second =
      split_by_conditions(truth_of_four_images(), {found(1, 0)}, options, spec, 2);
  CHECK(second.at({1, 0.001}).instances == 1);
  CHECK(second.at({2, 0.002}).recall() == 1);
}

TEST_CASE("replicas with fixed specs ask for enough instances", "[experiment]") {
  const auto spec_of = [](const char* name) {
    return read_spec(std::string(POSEVOTE_SOURCE_DIR "/configs/") + name + "_scenes.yaml");
  };
  std::map<double, std::size_t> by_noise;
  const Spec parts = spec_of("parts");
  CHECK(parts.models.size() == 8);
  for (const SceneSpec& scene : parts.scenes) by_noise[scene.noise] += scene.objects.size();
  REQUIRE(by_noise.size() == 3);
  for (const double noise : {0.0001, 0.0005, 0.002}) CHECK(by_noise.at(noise) == 400);
  const Spec household = spec_of("household");
  std::map<int, int> by_object;
  for (const SceneSpec& scene : household.scenes)
    for (const int obj_id : scene.objects) ++by_object[obj_id];
  REQUIRE(by_object.size() == 21);
  for (const auto& [obj_id, count] : by_object) CHECK(count == 15);
  std::map<Conditions, int> cells;
  for (const SceneSpec& scene : spec_of("ranges").scenes) ++cells[{scene.distance, scene.noise}];
  REQUIRE(cells.size() == 18);
  for (const auto& [conditions, images] : cells) CHECK(images == 6);
}

TEST_CASE("ranges takes our method alone, and at the scales asked for", "[experiment]") {
  ExperimentCommand command;
  command.name = "ranges";
  command.scales = {0.001, 0.0025};
  const std::vector<Method> methods = methods_of(command);
  REQUIRE(methods.size() == 3);
  CHECK(methods[0].name == "posevote");
  CHECK(methods[0].set.empty());
  CHECK(methods[2].name == "posevote_2.5mm");
  CHECK(methods[2].set == std::vector<std::string>{"derive_scale.resolution=0.0025"});
  command.name = "parts";
  CHECK_THROWS_WITH(methods_of(command), Contains("ranges"));
}

}  // namespace posevote::experiment_test
