// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>

#include "nodes/data/features.hpp"
#include "nodes/data/model.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::derive_scale_test {

using Catch::Matchers::Contains;

namespace {

struct Derived {
  PerObject<Mesh> meshes;
  std::vector<float> resolutions;
};

Derived derive(const std::vector<Mesh>& models,
               const std::map<std::string, std::string>& params = {}) {
  PerObject<Mesh> meshes;
  for (const Mesh& mesh : models) meshes.slots.push_back(std::make_shared<const Mesh>(mesh));
  const auto outputs = test::run_outputs("derive_scale", params, std::move(meshes));
  Derived derived{graph::StreamTraits<PerObject<Mesh>>::unwrap(outputs.at(0)), {}};
  const auto scales = graph::StreamTraits<PerObject<Scale>>::unwrap(outputs.at(1));
  for (const auto& slot : scales.slots) derived.resolutions.push_back(slot->resolution);
  return derived;
}

/// The finest of all models.
float derived(const std::vector<Mesh>& models,
              const std::map<std::string, std::string>& params = {}) {
  const std::vector<float> all = derive(models, params).resolutions;
  REQUIRE(all.size() == 4 * models.size());
  for (std::size_t i = 0; i < models.size(); ++i) CHECK(all[i] == all[0]);
  return all[0];
}

}  // namespace

TEST_CASE("derive_scale is a share of the mean diagonal", "[prepare]") {
  const Mesh small = test::box({5, 0, 0}, 0.1F);
  const Mesh large = test::box({0, 0, 7}, 0.3F);
  CHECK(derived({small, large}) == Approx(0.0085 * 0.2 * std::sqrt(3)));
  CHECK(derived({large, small}) == derived({small, large}));
  CHECK(derived({small, large}, {{"fraction", "0.01"}}) == Approx(0.01 * 0.2 * std::sqrt(3)));
}

TEST_CASE("derive_scale is never finer than the finest, unless it is given", "[prepare]") {
  const Mesh tiny = test::box({0, 0, 0}, 0.01F);
  CHECK(derived({tiny}) == Approx(0.0085 * 0.01 * std::sqrt(3)));
  CHECK(derived({tiny}, {{"finest", "0.0005"}}) == Approx(0.0005));
  CHECK(derived({tiny}, {{"resolution", "0.002"}}) == Approx(0.002));
}

TEST_CASE("an own scale follows from the object's size, whatever the others", "[prepare]") {
  const Mesh small = test::box({5, 0, 0}, 0.1F);  // 0.0085 x its diagonal: 1.47 mm
  const Mesh large = test::box({0, 0, 7}, 0.3F);  // 4.42 mm
  const auto own = [](const std::vector<Mesh>& models) {
    return derive(models, {{"own", "true"}, {"octaves", "1"}}).resolutions;
  };
  CHECK(own({small, large}) == std::vector<float>{own({small})[0], own({large})[0]});
  CHECK(own({small})[0] == Approx(0.00125));
  CHECK(own({large})[0] == Approx(0.005));
}

TEST_CASE("octaves grow by steps, all models at one before the next", "[prepare]") {
  const Mesh a = test::box({0, 0, 0}, 0.1F), b = test::box({1, 0, 0}, 0.2F);
  const Derived all = derive({a, b}, {{"octaves", "3"}, {"step", "2"}, {"resolution", "0.001"}});
  CHECK(all.resolutions == std::vector<float>{0.001F, 0.001F, 0.002F, 0.002F, 0.004F, 0.004F});
  REQUIRE(all.meshes.size() == 6);
  CHECK(all.meshes[4].points == a.points);
  CHECK(all.meshes[5].points == b.points);
  const std::vector<float> half = derive({a}, {{"resolution", "0.001"}}).resolutions;
  REQUIRE(half.size() == 4);
  CHECK(half[1] == Approx(0.001 * std::sqrt(2)));
  CHECK(half[2] == Approx(0.002));
}

TEST_CASE("derive_scale refuses models that have no size", "[prepare]") {
  const Mesh good = test::box({0, 0, 0}, 0.1F);
  CHECK_THROWS_WITH(derive({}), Contains("no models"));
  CHECK_THROWS_WITH(derive({good, Mesh{}}), Contains("model 2 of 2 has 0 points"));
  Mesh point;
  point.points = PointMatrix::Ones(3, 3);
  CHECK_THROWS_WITH(derive({point}), Contains("no extent"));
  CHECK(derived({point}, {{"resolution", "0.002"}}) == Approx(0.002));
}

}  // namespace posevote::derive_scale_test
