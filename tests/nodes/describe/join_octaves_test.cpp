// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/descriptors/octaves.hpp"
#include "tests/nodes/match/small_library.hpp"

namespace posevote::join_octaves_test {

using namespace posevote::test;

namespace {

template <class T>
PerObject<T> list_of(const std::vector<T>& values) {
  PerObject<T> list;
  for (const T& value : values) list.slots.push_back(std::make_shared<const T>(value));
  return list;
}

}  // namespace

TEST_CASE("the features of all octaves of a scan come together", "[describe]") {
  const Cloud fine = box_cloud({0, 0, 0}, {1, 1, 1}), coarse = box_cloud({0, 0, 0}, {2, 2, 2});
  const auto outputs =
      run_outputs("join_octaves", {}, list_of<Cloud>({fine, coarse, coarse}),
                  list_of<FeatureSet>({features_at({1, 2}), features_at({}), features_at({3})}),
                  list_of<Scale>({{0.001F}, {0.002F}, {0.004F}}));
  CHECK(graph::StreamTraits<Cloud>::unwrap(outputs.at(0)).points == fine.points);
  const FeatureSet all = graph::StreamTraits<FeatureSet>::unwrap(outputs.at(1));
  REQUIRE(all.octaves.size() == 2);
  CHECK(descriptors_of(all, all.octaves[0]) == Eigen::Vector2f(1, 2));
  CHECK(descriptors_of(all, all.octaves[1])(0, 0) == 3);
  CHECK(all.octaves[0].resolution == 0.001F);
  CHECK(all.octaves[1].resolution == 0.004F);
  CHECK(all.octaves[1].begin == 2);
  CHECK(all.octaves[1].end == 3);
}

TEST_CASE("a scan without features in any octave is refused, and descriptors that differ",
          "[describe]") {
  const Cloud cloud = box_cloud({0, 0, 0}, {1, 1, 1});
  const auto join = [&](const FeatureSet& a, const FeatureSet& b) {
    return run_outputs("join_octaves", {}, list_of<Cloud>({cloud, cloud}),
                       list_of<FeatureSet>({a, b}), list_of<Scale>({{0.001F}, {0.002F}}));
  };
  CHECK_THROWS_WITH(join(features_at({}), features_at({})),
                    Catch::Contains("no feature point of the scan"));
  FeatureSet wide = features_at({1});
  wide.descriptors.setZero(1, 2);
  CHECK_THROWS_WITH(join(features_at({1}), wide), Catch::Contains("of 1 and of 2 numbers"));
}

TEST_CASE("features match at their own scale alone", "[describe]") {
  Model model = *make_library({{0}}).models[0];
  const auto at = [](const std::vector<float>& values) {
    return std::make_shared<const FeatureSet>(features_at(values));
  };
  model.features = descriptors::stack_octaves({at({10}), at({20})}, {{0.001F}, {0.002F}});
  ModelLibrary library;
  library.models = {std::make_shared<const Model>(model)};
  library.octaves = descriptors::index_octaves(library.models, {});
  REQUIRE(library.octaves.size() == 2);
  const auto match = [&](float resolution) {
    return run_node<PerObject<Correspondences>>(
        "match_features", {}, descriptors::stack_octaves({at({11, 19})}, {{resolution}}),
        library)[0];
  };
  CHECK(match(0.001F).model_feature == std::vector<std::uint32_t>{0, 0});
  CHECK(match(0.002F).model_feature == std::vector<std::uint32_t>{1, 1});
  CHECK(match(0.002F).distance == std::vector<float>{9, 1});
  CHECK(match(0.004F).model_feature.empty());
}

TEST_CASE("a model is judged at the scale of the scan", "[describe]") {
  Model model;
  model.resolution = 0.001F;
  for (const float resolution : {0.002F, 0.004F}) {
    Model next;
    next.resolution = resolution;
    model.coarser.push_back(std::make_shared<const Model>(next));
  }
  CHECK(model.at(0.0005F).resolution == 0.001F);
  CHECK(model.at(0.002F).resolution == 0.002F);
  CHECK(model.at(0.003F).resolution == 0.004F);
  CHECK(model.at(1).resolution == 0.004F);
}

}  // namespace posevote::join_octaves_test
