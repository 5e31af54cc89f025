// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/nodes/match/small_library.hpp"

namespace posevote::match_features_test {

using namespace posevote::test;

namespace {

PerObject<Correspondences> match(const std::vector<float>& scene, const ModelLibrary& library,
                                 const std::map<std::string, std::string>& params = {}) {
  return run_node<PerObject<Correspondences>>("match_features", params, features_at(scene),
                                              library);
}

using Rows = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("each scene feature votes for the owner of its nearest descriptor", "[match]") {
  const ModelLibrary library = make_library({{0, 10}, {100}, {20, 30, 40}});
  const auto found = match({9, 42, 1, 31}, library);
  REQUIRE(found.size() == 3);
  CHECK(found[0].scene_feature == Rows{0, 2});
  CHECK(found[0].model_feature == Rows{1, 0});
  CHECK(found[0].distance == std::vector<float>{1, 1});
  CHECK(found[0].ratio[0] == Approx(1.0 / 81));
  CHECK(found[0].ratio[1] == Approx(1.0 / 81));
  CHECK(found[1].scene_feature.empty());
  CHECK(found[2].scene_feature == Rows{1, 3});
  CHECK(found[2].model_feature == Rows{2, 1});
  CHECK(found[2].distance == std::vector<float>{2, 1});
  CHECK(found[2].ratio[0] == Approx(4.0 / 144));  // the second nearest is of the same object
  for (std::size_t i = 0; i < 3; ++i) CHECK(found[i].model == library.models[i]);
}

TEST_CASE("matches are the same whichever exact search and order of models", "[match]") {
  const std::vector<float> scene = {3, 17, 26, 90};
  const auto a = match(scene, make_library({{0, 10}, {20, 30}}, {{"search", "kd_tree"}}));
  const auto b = match(scene, make_library({{20, 30}, {0, 10}}, {}, {2, 1}));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(a[i].scene_feature == b[i].scene_feature);
    CHECK(a[i].model_feature == b[i].model_feature);
    CHECK(a[i].ratio == b[i].ratio);
  }
}

TEST_CASE("a match that fits twice is worth nothing: 0/0 is 1", "[match]") {
  const auto found = match({5}, make_library({{5, 5}}));
  CHECK(found[0].model_feature == Rows{0});
  CHECK(found[0].ratio == std::vector<float>{1});
  CHECK(match({6}, make_library({{5}}))[0].ratio == std::vector<float>{1});
}

TEST_CASE("poor matches can be left out", "[match]") {
  const ModelLibrary library = make_library({{0, 10}, {100}});
  const auto distinct = match({4, 1, 130}, library, {{"max_ratio", "0.2"}});
  CHECK(distinct[0].scene_feature == Rows{1});
  CHECK(distinct[1].scene_feature == Rows{2});
  const auto near = match({4, 1, 130}, library, {{"max_distance", "4.5"}});
  CHECK(near[0].scene_feature == Rows{0, 1});
  CHECK(near[1].scene_feature.empty());
  CHECK_THROWS(match({4}, library, {{"max_ratio", "1.5"}}));
}

TEST_CASE("of many matches of an object the most distinctive can be kept", "[match]") {
  const ModelLibrary library = make_library({{0, 10}, {100}});
  const std::vector<float> scene = {4, 1, 3, 9, 130, 2};  // ratios of the first: 4:6, 1:9, 3:7 ...
  const auto all = match(scene, library, {{"most", "0"}});
  CHECK(all[0].scene_feature == Rows{0, 1, 2, 3, 5});
  const auto few = match(scene, library, {{"most", "3"}});
  CHECK(few[0].scene_feature == Rows{1, 3, 5});
  CHECK(few[0].model_feature == Rows{0, 1, 0});
  CHECK(few[0].distance == std::vector<float>{1, 1, 2});
  CHECK(few[0].ratio[1] == all[0].ratio[3]);
  CHECK(few[1].scene_feature == Rows{4});
  CHECK(match(scene, library, {{"most", "1"}})[0].scene_feature == Rows{1});  // 1:9 as 9:1
}

TEST_CASE("matching refuses descriptors of another length and a library without index", "[match]") {
  ModelLibrary library = make_library({{0, 10}});
  FeatureSet wide = features_at({1, 2});
  wide.descriptors.setZero(2, 3);
  CHECK_THROWS_WITH(run_node<PerObject<Correspondences>>("match_features", {}, wide, library),
                    Catch::Contains("3 numbers, the library's 1"));
  library.octaves.clear();
  CHECK_THROWS_WITH(match({1}, library), Catch::Contains("no index"));
}

}  // namespace posevote::match_features_test
