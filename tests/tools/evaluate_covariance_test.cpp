// SPDX-License-Identifier: BSD-3-Clause
// Whether covariances say how far poses are off, and confidences which of its look-alikes one is.
#include <cmath>
#include <random>

#include "nodes/formats/results_files.hpp"
#include "tests/tools/truth_set.hpp"
#include "tools/evaluate/results_json.hpp"

namespace posevote::evaluate_covariance_test {

using namespace posevote::test;

namespace {

/// One detection of the bar that stands at (0, 0, 1) m in image 3 of scene 1.
struct Found {
  geometry::Vector6d error = geometry::Vector6d::Zero();
  geometry::Matrix6d covariance = geometry::Matrix6d::Identity();
  int obj_id = 1;

  FoundInstance instance() const {
    FoundInstance found;
    found.scene_id = 1, found.im_id = 3, found.obj_id = obj_id, found.score = 0.9;
    const Eigen::Translation3d place(0, obj_id == 1 ? 0 : 0.2, 1);
    found.T_scene_model = place * geometry::exp_motion(error).inverse();
    found.covariance = covariance;
    return found;
  }
};

double surprise(const TruthSet& set, const Found& found) {
  EvaluateOptions options;
  options.rules = "pose";
  const Evaluation got =
      evaluate(layouts::read_ground_truth(set.path(), "test"), {found.instance()}, options);
  return got.all[0].verdicts.at(0).surprise;
}

}  // namespace

TEST_CASE("a pose error is measured by its covariance, the translation first", "[evaluate]") {
  const TruthSet set;
  Found found;
  found.error << 0.01, 0, 0, 0, 0.02, 0;
  found.covariance.diagonal() << 0.02 * 0.02, 1, 1, 1, 0.01 * 0.01, 1;
  CHECK(surprise(set, found) == Approx(2 * 2 + 0.5 * 0.5));
  found.covariance(1, 1) = 0;  // no covariance
  CHECK(std::isnan(surprise(set, found)));
}

TEST_CASE("what a symmetry carries onto the truth is no error", "[evaluate]") {
  const TruthSet set;
  Found found;
  found.obj_id = 2;  // looks the same after half a turn about z through (0.01, 0, 0)
  found.error << 0, -M_PI * 0.01, 0, 0, 0, M_PI;
  found.covariance *= 1e-6;
  CHECK(surprise(set, found) == Approx(0).margin(1e-6));
}

TEST_CASE("a turn about an axis of symmetry is no error, between steps either", "[evaluate]") {
  const TruthSet set;
  set.write("models/models_info.json", R"({"1": {"diameter": 205, "min_x": -90, "min_y": -20,
    "min_z": -10, "size_x": 200, "size_y": 40, "size_z": 20,
    "symmetries_continuous": [{"axis": [1, 0, 0], "offset": [0, 0, 0]}]},
    "2": {"diameter": 205, "min_x": -90, "min_y": -20, "min_z": -10, "size_x": 200, "size_y": 40,
    "size_z": 20}})");
  Found found;
  found.covariance *= 1e-6;
  for (const double turn : {0.009, 0.5, 2.345}) {
    found.error << 0.001, 0, 0, turn, 0, 0;
    CHECK(surprise(set, found) == Approx(1).epsilon(0.01));
  }
}

TEST_CASE("of errors that are as they are said to be, 95 in a hundred are within the ellipsoid",
          "[evaluate]") {
  const TruthSet set;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, 6, 6> root = Eigen::Matrix<double, 6, 6>::Identity() * 2e-3;
  root(4, 1) = 1e-3, root(5, 0) = -2e-3;
  int within = 0;
  constexpr int kCount = 500;
  for (int i = 0; i < kCount; ++i) {
    geometry::Vector6d z;
    for (double& value : z) value = normal(random);
    Found found;
    found.error = root * z;
    found.covariance = root * root.transpose();
    within += surprise(set, found) <= 12.592;
  }
  CHECK(within > 0.92 * kCount);
  CHECK(within < 0.98 * kCount);
}

TEST_CASE("a rule that takes look-alikes judges the confidence, others that of the very pose",
          "[evaluate]") {
  const TruthSet set;
  FoundInstance found = Found().instance();
  found.score = 0.9, found.pose_confidence = 0.3;
  EvaluateOptions options;
  options.rules = "add,adds";
  const auto truth = layouts::read_ground_truth(set.path(), "test");
  const Evaluation got = evaluate(truth, {found}, options);
  CHECK(calibration_error(got.all[0]) == Approx(0.7));
  CHECK(calibration_error(got.all[1]) == Approx(0.1));
  found.pose_confidence.reset();
  CHECK(calibration_error(evaluate(truth, {found}, options).all[0]) == Approx(0.1));
}

TEST_CASE("rows of results.csv get their covariances from the results.json beside it",
          "[evaluate]") {
  const TruthSet set;
  Detections detections;
  for (int i = 0; i < 3; ++i) {
    Detection& detection = detections.items.emplace_back();
    detection.obj_id = 1, detection.model = "bar", detection.confidence = 0.9;
    detection.T_scene_model.translation() << 0.3 * i, 0, 1;
    if (i < 2) detection.covariance = geometry::Matrix6d::Identity() * (i == 0 ? 1e-6 : 1e-4);
  }
  detections.items[0].T_scene_model.translation().x() += 0.004;
  detections.items[1].T_scene_model.translation().x() += 0.004;
  formats::FrameReport frame;
  frame.file.scene_id = 1, frame.file.im_id = 3;
  formats::begin_results(set / "out");
  formats::ResultsWriter(set / "out").write(frame, detections, {});
  for (const char* file : {"out/results.csv", "out/results.json"}) {
    EvaluateOptions options;
    options.rules = "pose";
    const Evaluation got = evaluate(layouts::read_ground_truth(set.path(), "test"),
                                    read_results((set / file).string()), options);
    const Coverage coverage = coverage_of(got.all[0]);
    CHECK(coverage.known == 2);
    CHECK(coverage.within == 1);
    CHECK(coverage.share() == 0.5);
    CHECK_THAT(to_text(got, false),
               Catch::Contains("in 95%") && Catch::Contains(" 0.500   2 of 3"));
  }
  std::filesystem::remove(set / "out/results.json");
  const auto rows = read_results((set / "out/results.csv").string());
  CHECK(rows.size() == 3);
  CHECK_FALSE(rows[0].covariance);
}

}  // namespace posevote::evaluate_covariance_test
