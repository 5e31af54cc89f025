// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/data/hypotheses.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::ransac_test {

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

TEST_CASE("ransac needs correspondences that span a triangle", "[baseline]") {
  Scene scene(0);
  scene.matches.scene_feature.assign(50, 0);  // one and the same place
  scene.matches.model_feature.assign(50, 0);
  CHECK(ransac(scene).items.empty());
}

TEST_CASE("ransac keeps as many as it is asked for", "[baseline]") {
  const Hypotheses all = ransac(Scene(0.3));
  const Hypotheses few = ransac(Scene(0.3), {{"most", "3"}});
  REQUIRE(few.items.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(few.items[i].support == all.items[i].support);
}

}  // namespace posevote::ransac_test
