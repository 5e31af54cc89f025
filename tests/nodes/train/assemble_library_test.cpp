// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/nodes/match/small_library.hpp"

namespace posevote::assemble_library_test {

using namespace posevote::test;

namespace {

template <class T>
PerObject<T> one_empty() {
  PerObject<T> list;
  list.slots = {std::make_shared<const T>()};
  return list;
}

PerObject<Scale> one_octave() {
  PerObject<Scale> list;
  list.slots = {std::make_shared<const Scale>(Scale{0.002F})};
  return list;
}

}  // namespace

TEST_CASE("a library holds the models by obj_id, with centre and diagonal of the mesh", "[match]") {
  const ModelLibrary library = make_library({{1, 2}, {3}, {4}}, {}, {7, 2, 5});
  REQUIRE(library.models.size() == 3);
  CHECK(library.octaves.at(0).resolution == 0.002F);
  CHECK(library.models[0]->resolution == 0.002F);
  CHECK(library.models[0]->obj_id == 2);
  CHECK(library.models[0]->name == "m2");
  CHECK(library.models[1]->obj_id == 5);
  CHECK(library.models[2]->obj_id == 7);
  CHECK(library.models[2]->features.points.rows() == 2);
  CHECK(library.models[1]->center.isApprox(Eigen::Vector3f(0.5F, 2.5F, 1)));
  CHECK(library.models[1]->diagonal == Approx(std::sqrt(30.0)));
}

TEST_CASE("the centre is that of the mesh, not of the sampled cloud", "[match]") {
  PerObject<Mesh> mesh;
  PerObject<Cloud> cloud;
  PerObject<FeatureSet> features;
  mesh.slots = {
      std::make_shared<const Mesh>(Mesh{box_cloud({-2, 0, 0}, {4, 1, 1}).points, {}, {}})};
  cloud.slots = {std::make_shared<const Cloud>(box_cloud({0, 0, 0}, {1, 1, 1}))};
  features.slots = {std::make_shared<const FeatureSet>(features_at({1}))};
  const auto library = run_node<ModelLibrary>(
      "assemble_library", {}, ModelFiles{{"a.ply", 1, "a"}}, mesh, cloud, features,
      one_empty<Symmetries>(), one_empty<NearSymmetries>(), one_empty<Outline>(), one_octave());
  CHECK(library.models[0]->center.isApprox(Eigen::Vector3f(1, 0.5F, 0.5F)));
  CHECK(library.models[0]->cloud.points == cloud[0].points);
}

TEST_CASE("symmetries said of a model override those found", "[match]") {
  PerObject<Mesh> mesh;
  PerObject<Cloud> cloud;
  PerObject<FeatureSet> features;
  PerObject<Symmetries> found;
  mesh.slots = {std::make_shared<const Mesh>(Mesh{box_cloud({0, 0, 0}, {4, 1, 1}).points, {}, {}})};
  cloud.slots = {std::make_shared<const Cloud>(box_cloud({0, 0, 0}, {4, 1, 1}))};
  features.slots = {std::make_shared<const FeatureSet>(features_at({1}))};
  Symmetries half_turn;
  half_turn.turns.emplace_back(0, 1, 0, 0);
  found.slots = {std::make_shared<const Symmetries>(half_turn)};
  ModelFile file{"a.ply", 1, "a"};
  const auto turns = [&] {
    return run_node<ModelLibrary>("assemble_library", {}, ModelFiles{file}, mesh, cloud, features,
                                  found, one_empty<NearSymmetries>(), one_empty<Outline>(),
                                  one_octave())
        .models[0]
        ->symmetries.turns.size();
  };
  CHECK(turns() == 2);
  file.symmetries = Symmetries{};
  CHECK(turns() == 1);
}

TEST_CASE("a library refuses what does not fit together", "[match]") {
  CHECK_THROWS_WITH(make_library({}), Catch::Contains("no models"));
  CHECK_THROWS_WITH(make_library({{1}, {2}}, {}, {3, 3}), Catch::Contains("same obj_id 3"));
  CHECK_THROWS_WITH(make_library({{1}}, {{"search", "quick"}}), Catch::Contains("search"));
  CHECK_THROWS_WITH(run_node<ModelLibrary>(
                        "assemble_library", {}, ModelFiles{{"a.ply", 1, "a"}}, PerObject<Mesh>{},
                        PerObject<Cloud>{}, PerObject<FeatureSet>{}, PerObject<Symmetries>{},
                        PerObject<NearSymmetries>{}, PerObject<Outline>{}, one_octave()),
                    Catch::Contains("1 model files in 1 octaves, but 0 results"));
  PerObject<FeatureSet> features;
  features.slots = {std::make_shared<const FeatureSet>(features_at({1}))};
  CHECK_THROWS_WITH(run_node<ModelLibrary>("assemble_library", {}, ModelFiles{{"a.ply", 1, "a"}},
                                           one_empty<Mesh>(), one_empty<Cloud>(), features,
                                           one_empty<Symmetries>(), one_empty<NearSymmetries>(),
                                           one_empty<Outline>(), one_octave()),
                    Catch::Contains("a.ply: has no points"));
}

}  // namespace posevote::assemble_library_test
