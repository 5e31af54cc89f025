// SPDX-License-Identifier: BSD-3-Clause
#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>

#include "nodes/data/hypotheses.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

using namespace posevote;
using namespace posevote::test;

namespace {

const Placed kBody{1, pose(-0.02, 0.01, 0.8, 0.7)};

struct Scene {
  FeatureSet features = features_of(scan_of({kBody}));
  Correspondences matches;
  explicit Scene(double wrong) : matches(match_truly(bumpy_model(1), features, {kBody}, wrong)) {}
};

using Values = std::map<std::string, std::string>;

Hypotheses ransac(const Scene& scene, const Values& values = {}) {
  return run_node<Hypotheses>("ransac", values, scene.matches, scene.features, Scale{kResolution});
}

}  // namespace

TEST_CASE("ransac finds the pose among wrong matches", "[baseline]") {
  for (const double wrong : {0.0, 0.5, 0.8}) {
    const Hypotheses found = ransac(Scene(wrong));
    INFO(wrong);
    REQUIRE(!found.items.empty());
    const Eigen::Isometry3d error = found.items[0].T_scene_model.inverse() * kBody.T_scene_model;
    CHECK(error.translation().norm() < 0.01);
    CHECK(Eigen::AngleAxisd(error.linear()).angle() < 0.15);
    for (std::size_t i = 1; i < found.items.size(); ++i)
      CHECK(found.items[i - 1].support >= found.items[i].support);
  }
}

TEST_CASE("ransac gives the same hypotheses at any number of threads", "[baseline]") {
  const Scene scene(0.7);
  const Hypotheses two = ransac(scene, {{"iterations", "2000"}});
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Hypotheses again = ransac(scene, {{"iterations", "2000"}});
  REQUIRE(two.items.size() == again.items.size());
  REQUIRE(!two.items.empty());
  for (std::size_t i = 0; i < two.items.size(); ++i) {
    CHECK(two.items[i].support == again.items[i].support);
    CHECK(two.items[i].T_scene_model.matrix() == again.items[i].T_scene_model.matrix());
  }
}

TEST_CASE("ransac needs three correspondences that span a triangle", "[baseline]") {
  Scene scene(0);
  scene.matches.scene_feature.resize(2);
  scene.matches.model_feature.resize(2);
  CHECK(ransac(scene).items.empty());
  scene.matches.scene_feature.assign(50, 0);  // one and the same place
  scene.matches.model_feature.assign(50, 0);
  CHECK(ransac(scene).items.empty());
  scene.matches.scene_feature.clear();
  scene.matches.model_feature.clear();
  CHECK(ransac(scene).items.empty());
}

TEST_CASE("ransac keeps as many as it is asked for", "[baseline]") {
  const Hypotheses all = ransac(Scene(0.3));
  const Hypotheses few = ransac(Scene(0.3), {{"most", "3"}});
  REQUIRE(few.items.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(few.items[i].support == all.items[i].support);
}
