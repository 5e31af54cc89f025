// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>

#include "nodes/data/features.hpp"
#include "nodes/data/model.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

using namespace posevote;
using Catch::Matchers::Contains;

namespace {

float derived(const std::vector<Mesh>& models,
              const std::map<std::string, std::string>& params = {}) {
  PerObject<Mesh> meshes;
  for (const Mesh& mesh : models) meshes.slots.push_back(std::make_shared<const Mesh>(mesh));
  return test::run_node<Scale>("derive_scale", params, std::move(meshes)).resolution;
}

}  // namespace

TEST_CASE("derive_scale is a share of the mean diagonal", "[prepare]") {
  const Mesh small = test::box({5, 0, 0}, 0.1F);
  const Mesh large = test::box({0, 0, 7}, 0.3F);
  CHECK(derived({small, large}) == Approx(0.006 * 0.2 * std::sqrt(3)));
  CHECK(derived({large, small}) == derived({small, large}));
  CHECK(derived({small, large}, {{"fraction", "0.01"}}) == Approx(0.01 * 0.2 * std::sqrt(3)));
}

TEST_CASE("derive_scale is never finer than the finest, unless it is given", "[prepare]") {
  const Mesh tiny = test::box({0, 0, 0}, 0.01F);
  CHECK(derived({tiny}) == Approx(0.0005));
  CHECK(derived({tiny}, {{"finest", "0"}}) == Approx(0.006 * 0.01 * std::sqrt(3)));
  CHECK(derived({tiny}, {{"resolution", "0.002"}}) == Approx(0.002));
}

TEST_CASE("derive_scale refuses models that have no size", "[prepare]") {
  const Mesh good = test::box({0, 0, 0}, 0.1F);
  CHECK_THROWS_WITH(derived({}), Contains("no models"));
  CHECK_THROWS_WITH(derived({good, Mesh{}}), Contains("model 2 of 2 has 0 points"));
  Mesh point;
  point.points = PointMatrix::Ones(3, 3);
  CHECK_THROWS_WITH(derived({point}), Contains("no extent"));
  CHECK(derived({}, {{"resolution", "0.002"}}) == Approx(0.002));
}

TEST_CASE("library_scale hands on the library's scale", "[prepare]") {
  ModelLibrary library;
  library.scale.resolution = 0.00175F;
  CHECK(test::run_node<Scale>("library_scale", {}, library).resolution == 0.00175F);
}
