// SPDX-License-Identifier: BSD-3-Clause
#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "nodes/data/hypotheses.hpp"
#include "nodes/data/ppf_model.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::opencv_ppf_test {

using namespace posevote::test;

namespace {

const Placed kBody{1, pose(-0.02, 0.01, 0.8, 0.7)};

bool skipped() {
  if (graph::find_node("opencv_ppf")) return false;
  WARN("skipped: built without OpenCV");
  return true;
}

std::string message(const std::function<void()>& run) {
  try {
    run();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// Coarse, because training is quadratic.
PerObject<PpfModel> train(const std::vector<std::shared_ptr<const Model>>& models,
                          const std::string& sampling = "0.1") {
  return run_node<PerObject<PpfModel>>("train_opencv_ppf", {{"sampling", sampling}},
                                       ModelLibrary{models, {}});
}

Hypotheses find(const PpfModel& trained, const FeatureSet& features) {
  return run_node<Hypotheses>("opencv_ppf", {}, trained, features);
}

Hypotheses find(const PpfModel& trained, const Cloud& scan) {
  return find(trained, features_of(scan, 1));
}

bool is_near(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth) {
  const Eigen::Isometry3d error = found.inverse() * truth;
  return error.translation().norm() < 0.02 && Eigen::AngleAxisd(error.linear()).angle() < 0.4;
}

}  // namespace

TEST_CASE("opencv_ppf finds a body wherever it stands", "[baseline][ppf]") {
  if (skipped()) return;
  const PerObject<PpfModel> trained = train({bumpy_model(1)});
  for (const double angle : {0.7, 2.5}) {
    const Placed body{1, pose(0.03, -0.02, 0.7, angle, {0.9, 0.1, -0.4})};
    const Hypotheses found = find(trained[0], scan_of({body}, false));
    INFO("turned by " << angle);
    REQUIRE(!found.items.empty());
    CHECK(found.model->name == "bumpy1");
    const auto T_of = [&](const Hypothesis& one) {
      return T_scene_model_of(one, found.model->center);
    };
    CHECK(is_near(T_of(found.items[0]), body.T_scene_model));
    for (std::size_t i = 0; i < found.items.size(); ++i) {
      const Eigen::Matrix3d R = T_of(found.items[i]).linear();
      CHECK(R.isUnitary(1e-6));
      CHECK(R.determinant() > 0);
      if (i > 0) CHECK(found.items[i - 1].support >= found.items[i].support);
    }
  }
}

TEST_CASE("opencv_ppf gives the same at any number of threads", "[baseline][ppf]") {
  if (skipped()) return;
  const Cloud scan = scan_of({kBody, {2, pose(0.1, 0, 0.8, 1)}}, false);
  const auto run = [&] {
    std::vector<Hypothesis> all;
    const PerObject<PpfModel> trained = train({bumpy_model(1), bumpy_model(2)}, "0.15");
    for (const auto& object : trained.slots)
      for (const Hypothesis& one : find(*object, scan).items) all.push_back(one);
    return all;
  };
  const std::vector<Hypothesis> two = run();
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<Hypothesis> again = run();
  REQUIRE(two.size() == again.size());
  REQUIRE(!two.empty());
  for (std::size_t i = 0; i < two.size(); ++i) {
    CHECK(two[i].support == again[i].support);
    CHECK(two[i].center == again[i].center);
    CHECK(two[i].rotation.coeffs() == again[i].rotation.coeffs());
  }
}

TEST_CASE("opencv_ppf finds nothing in a scan of nothing, or of no depth", "[baseline][ppf]") {
  if (skipped()) return;
  const PerObject<PpfModel> trained = train({bumpy_model(1)});
  const Cloud scan = scan_of({kBody}, false);
  CHECK(!find(trained[0], scan).items.empty());
  Cloud flat = scan;
  flat.points.col(2).setConstant(1);
  CHECK(find(trained[0], flat).items.empty());
  Cloud spoilt = scan;
  spoilt.points.setConstant(std::numeric_limits<float>::quiet_NaN());
  CHECK(find(trained[0], spoilt).items.empty());
  for (const Eigen::Index rows : {2, 1, 0}) {
    Cloud few;
    few.points = scan.points.topRows(rows);
    few.normals = scan.normals.topRows(rows);
    CHECK(find(trained[0], few).items.empty());
  }
  FeatureSet bare = features_of(scan, 1);
  bare.normals.resize(0, 3);
  CHECK(message([&] { find(trained[0], bare); }).find("normals") != std::string::npos);
}

TEST_CASE("train_opencv_ppf names the model that it cannot train", "[baseline][ppf]") {
  if (skipped()) return;
  Model flat = *bumpy_model(1);
  flat.cloud.points.col(1).setZero();
  const auto broken = std::make_shared<const Model>(flat);
  CHECK(message([&] { train({broken}); }).find("bumpy1: has no extent") != std::string::npos);
  CHECK(message([&] { train({bumpy_model(1)}, "0.02"); }).find("too fine") != std::string::npos);
  CHECK(train({}).size() == 0);
}

}  // namespace posevote::opencv_ppf_test
