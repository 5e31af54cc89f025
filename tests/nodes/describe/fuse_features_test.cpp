// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/nodes/match/small_library.hpp"

namespace posevote::fuse_features_test {

using namespace posevote::test;

namespace {

/// Features at x = `places`, their descriptor the place times `factor`, `width` times over.
FeatureSet features_of_places(const std::vector<float>& places, float factor, Eigen::Index width) {
  FeatureSet features = features_at(places);
  for (Eigen::Index i = 0; i < features.points.rows(); ++i)
    features.points(i, 0) = places[static_cast<std::size_t>(i)];
  features.descriptors = (factor * features.descriptors).replicate(1, width).eval();
  return features;
}

FeatureSet fuse(const FeatureSet& a, const FeatureSet& b) {
  return run_node<FeatureSet>("fuse_features", {}, a, b);
}

}  // namespace

TEST_CASE("fused features have both descriptors of the same point side by side", "[match]") {
  const FeatureSet fused =
      fuse(features_of_places({1, 2, 3, 5}, 10, 2), features_of_places({0, 2, 3, 4, 5}, 100, 3));
  REQUIRE(fused.points.rows() == 3);  // the points that both describe
  CHECK(fused.points.col(0) == Eigen::Vector3f(2, 3, 5));
  CHECK(fused.normals.rows() == 3);
  CHECK(fused.blocks == std::vector<std::uint32_t>{2, 3});
  DescriptorMatrix expected(3, 5);
  expected << 20, 20, 200, 200, 200, 30, 30, 300, 300, 300, 50, 50, 500, 500, 500;
  CHECK(fused.descriptors == expected);
}

TEST_CASE("fusing again appends a block, on either side", "[match]") {
  const FeatureSet a = features_of_places({1, 2}, 1, 2), b = features_of_places({1, 2}, 2, 3);
  const FeatureSet c = features_of_places({2, 1}, 3, 1);
  const FeatureSet left = fuse(fuse(a, b), c), right = fuse(a, fuse(b, c));
  CHECK(left.blocks == std::vector<std::uint32_t>{2, 3, 1});
  CHECK(right.blocks == left.blocks);
  CHECK(right.descriptors == left.descriptors);
  CHECK(left.descriptors(1, 5) == 6);  // found though c stands in another order
}

TEST_CASE("features at one place are told apart by their normals, else kept in order", "[match]") {
  FeatureSet a = features_of_places({1, 1, 1}, 1, 1), b = a;
  a.descriptors << 1, 2, 3;
  b.descriptors << 10, 20, 30;
  b.normals.row(1) *= -1;
  const FeatureSet fused = fuse(a, b);
  DescriptorMatrix expected(2, 2);
  expected << 1, 10, 2, 30;
  CHECK(fused.descriptors == expected);
}

TEST_CASE("features of other points cannot be fused", "[match]") {
  CHECK_THROWS_WITH(fuse(features_of_places({1, 2}, 1, 1), features_of_places({3}, 1, 1)),
                    Catch::Contains("none of 2 and 1 features are the same"));
}

TEST_CASE("with a weight two descriptors become one", "[match]") {
  const FeatureSet a = features_of_places({1, 2}, 10, 2), b = features_of_places({1, 2}, 100, 1);
  const auto join = [](const FeatureSet& first, const FeatureSet& second) {
    return run_node<FeatureSet>("fuse_features", {{"weight", "0.5"}}, first, second);
  };
  const FeatureSet joined = join(a, b);
  DescriptorMatrix expected(2, 3);
  expected << 10, 10, 50, 20, 20, 100;
  CHECK(joined.descriptors == expected);
  CHECK(joined.blocks.empty());
  CHECK_THROWS_WITH(join(fuse(a, b), b), Catch::Contains("fused already"));
}

TEST_CASE("the descriptor that tells a point best matches it", "[match]") {
  // By the first descriptor the scene's feature is as near to 0 as to 2; by the second it is 20.
  FeatureSet model = features_at({0, 2});
  model.descriptors.conservativeResize(2, 2);
  model.descriptors.col(1) << 20, 40;
  model.blocks = {1, 1};
  ModelLibrary library = make_library({{0, 2}});
  Model fused = *library.models[0];
  fused.features = model;
  library.models[0] = std::make_shared<const Model>(std::move(fused));
  library.octaves = descriptors::index_octaves(library.models, {});
  FeatureSet scene = features_at({1.01F});
  scene.descriptors.conservativeResize(1, 2);
  scene.descriptors(0, 1) = 21;
  scene.blocks = {1, 1};
  const auto match = [&](const FeatureSet& features) {
    return run_node<PerObject<Correspondences>>("match_features", {}, features, library);
  };
  const auto found = match(scene);
  CHECK(found[0].model_feature == std::vector<std::uint32_t>{0});
  CHECK(found[0].distance == std::vector<float>{1});
  CHECK(found[0].ratio[0] == Approx(1.0 / 361));
  scene.blocks = {};
  CHECK_THROWS_WITH(match(scene), Catch::Contains("blocks of 1 1"));
}

}  // namespace posevote::fuse_features_test
