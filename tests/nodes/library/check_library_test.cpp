// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/check_library.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "tests/nodes/match/small_library.hpp"

namespace posevote::check_library_test {

using namespace posevote::test;

namespace {

/// What is said of a library whose second model was changed.
std::string complaint(const std::function<void(Model&)>& change) {
  ModelLibrary library = make_library({{0, 10}, {20, 30}});
  Model changed = *library.models[1];
  change(changed);
  library.models[1] = std::make_shared<const Model>(std::move(changed));
  try {
    library::check_library(library);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

const float kNan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("a library is refused for every value that nodes could not rely on", "[match]") {
  struct Fault {
    const char* said;
    std::function<void(Model&)> change;
  };
  const std::vector<Fault> faults = {
      {"the diagonal is 0", [](Model& m) { m.diagonal = 0; }},
      {"the diagonal is -1", [](Model& m) { m.diagonal = -1; }},
      {"the diagonal is nan", [](Model& m) { m.diagonal = kNan; }},
      {"no turn about a point", [](Model& m) { m.symmetries.turns.clear(); }},
      {"no turn about a point", [](Model& m) { m.symmetries.turns[0].w() = 2; }},
      {"no turn about a point", [](Model& m) { m.symmetries.axes[0].setZero(); }},
      {"no turn about a point", [](Model& m) { m.symmetries.fixed_point.x() = INFINITY; }},
      {"the outline's reach is 0", [](Model& m) { m.outline.reach = 0; }},
      {"points in the outline", [](Model& m) { m.outline.ends.pop_back(); }},
      {"the gaps' reach is 0", [](Model& m) { m.outline.gap_reach = 0; }},
      {"points of gaps", [](Model& m) { m.outline.gaps.pop_back(); }},
      {"points of bends", [](Model& m) { m.outline.bends = {0}; }},
      {"a bend names a point",
       [](Model& m) {
         m.outline.bends = {0, 3, 2};
       }},
      {"a near symmetry is no motion",
       [](Model& m) { m.near_symmetries.items[0].motion.linear() *= 2; }},
      {"a near symmetry names a point",
       [](Model& m) { m.near_symmetries.items[0].uncovered = {3}; }},
      {"the centre is not finite", [](Model& m) { m.center.y() = kNan; }},
      {"lie outside of the bounding box", [](Model& m) { m.center.y() = 50; }},
      {"points lie outside", [](Model& m) { m.cloud.points(1, 1) = 1e30F; }},
      {"feature points lie outside", [](Model& m) { m.features.points(1, 1) = -50; }},
      {"points that are not finite", [](Model& m) { m.cloud.points(1, 1) = kNan; }},
      {"a cloud has no points", [](Model& m) { m.cloud = {}; }},
      {"colours are not of all points", [](Model& m) { m.cloud.colors.setZero(2, 3); }},
      {"colours are not finite", [](Model& m) { m.cloud.colors.setConstant(3, 3, kNan); }},
      {"0 normals, expected 3", [](Model& m) { m.cloud.normals.resize(0, 3); }},
      {"2 normals, expected 3", [](Model& m) { m.cloud.normals.conservativeResize(2, 3); }},
      {"normal 2 has a squared length of 4", [](Model& m) { m.cloud.normals.row(2) *= 2; }},
      {"normal 0 has a squared length of nan", [](Model& m) { m.cloud.normals(0, 0) = kNan; }},
      {"1 feature normals, expected 2",
       [](Model& m) { m.features.normals.conservativeResize(1, 3); }},
      {"1 descriptors, expected 2",
       [](Model& m) {
         m.features.octaves[0].descriptors = std::make_shared<const DescriptorMatrix>(1, 1);
       }},
      {"feature points are not finite", [](Model& m) { m.features.points(0, 0) = kNan; }},
      {"feature normal 1 has a squared length of 0",
       [](Model& m) { m.features.normals.row(1).setZero(); }},
      {"obj_ids do not ascend", [](Model& m) { m.obj_id = 1; }}};
  CHECK(complaint([](Model&) {}).empty());
  for (const Fault& fault : faults)
    CHECK_THAT(complaint(fault.change), Catch::Contains(fault.said));
  CHECK_THAT(complaint(faults[0].change), Catch::Contains("model 'm2': "));
}

TEST_CASE("what a sound library may have", "[match]") {
  CHECK(complaint([](Model& m) { m.cloud.normals.row(1).setZero(); }).empty());  // unusable
}

TEST_CASE("a library without models or resolution is refused", "[match]") {
  ModelLibrary library = make_library({{0}});
  for (const float bad : {0.0F, -1.0F, kNan, std::numeric_limits<float>::infinity()})
    CHECK_THAT(complaint([bad](Model& m) { m.resolution = bad; }),
               Catch::Contains("the resolution is"));
  library.models.push_back(nullptr);
  CHECK_THROWS_WITH(library::check_library(library), Catch::Contains("a model is missing"));
  library.models.clear();
  CHECK_THROWS_WITH(library::check_library(library), Catch::Contains("no models"));
}

}  // namespace posevote::check_library_test
