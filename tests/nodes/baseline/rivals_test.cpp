// SPDX-License-Identifier: BSD-3-Clause
// What must hold for every rival that takes correspondences.
#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>

#include "nodes/data/hypotheses.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::rivals_test {

using namespace posevote::test;

namespace {

const Placed kBody{1, pose(-0.02, 0.01, 0.8, 0.7)};

struct Scene {
  Cloud cloud = scan_of({kBody});
  FeatureSet features = features_of(cloud);
  Correspondences matches;
  explicit Scene(double wrong) : matches(match_truly(bumpy_model(1), features, {kBody}, wrong)) {}
};

Hypotheses propose(const std::string& rival, const Scene& scene) {
  const Scale scale{kResolution};
  if (rival == "hough3d")
    return run_node<Hypotheses>("hough3d", {}, scene.matches, scene.features, scene.cloud, scale);
  return run_node<Hypotheses>(rival, {}, scene.matches, scene.features, scale);
}

const std::vector<std::string> kRivals = {"ransac", "hough3d", "geometric_consistency"};

}  // namespace

TEST_CASE("every rival finds the pose among wrong matches", "[baseline]") {
  for (const std::string& rival : kRivals)
    for (const double wrong : {0.0, 0.7}) {
      const Hypotheses found = propose(rival, Scene(wrong));
      INFO(rival << ", share of wrong matches " << wrong);
      REQUIRE(!found.items.empty());
      const Eigen::Isometry3d error =
          T_scene_model_of(found.items[0], found.model->center).inverse() * kBody.T_scene_model;
      CHECK(error.translation().norm() < 0.015);
      CHECK(Eigen::AngleAxisd(error.linear()).angle() < 0.2);
      for (std::size_t i = 1; i < found.items.size(); ++i)
        CHECK(found.items[i - 1].support >= found.items[i].support);
    }
}

TEST_CASE("every rival gives the same hypotheses at any number of threads", "[baseline]") {
  const Scene scene(0.7);
  for (const std::string& rival : kRivals) {
    const Hypotheses two = propose(rival, scene);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const Hypotheses again = propose(rival, scene);
    INFO(rival);
    REQUIRE(two.items.size() == again.items.size());
    for (std::size_t i = 0; i < two.items.size(); ++i) {
      CHECK(two.items[i].support == again.items[i].support);
      CHECK(two.items[i].center == again.items[i].center);
      CHECK(two.items[i].rotation.coeffs() == again.items[i].rotation.coeffs());
    }
  }
}

TEST_CASE("no rival finds anything in two correspondences, or none, or one place", "[baseline]") {
  Scene scene(0);
  const auto expect_nothing = [&] {
    for (const std::string& rival : kRivals) {
      INFO(rival << " of " << scene.matches.scene_feature.size());
      CHECK(propose(rival, scene).items.empty());
    }
  };
  scene.matches.scene_feature.resize(2);
  scene.matches.model_feature.resize(2);
  scene.matches.distance.resize(2);
  scene.matches.ratio.resize(2);
  expect_nothing();
  scene.matches = {scene.matches.model, {}, {}, {}, {}};
  expect_nothing();
}

}  // namespace posevote::rivals_test
