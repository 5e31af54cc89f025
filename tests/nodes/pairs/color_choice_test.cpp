// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/color_choice.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <numeric>

#include "nodes/pairs/pair_table.hpp"
#include "tests/support/bumpy_scene.hpp"

namespace posevote::color_choice_test {

using namespace posevote::test;

namespace {

using Light = Eigen::RowVector3f;

const Light kRed(0.6F, 0.05F, 0.05F), kBlue(0.05F, 0.05F, 0.6F), kGreen(0.05F, 0.5F, 0.05F);

constexpr std::size_t kMost = 97;  // no divisor of the wall's rows

/// A wall, blue but for a red strip, a tenth of it.
struct Scene {
  Scene() {
    wall.colors.resize(wall.points.rows(), 3);
    for (Eigen::Index i = 0; i < wall.points.rows(); ++i)
      wall.colors.row(i) = is_red(i) ? kRed : kBlue;
    for (Eigen::Index i = 0; i < wall.points.rows(); ++i)
      references.push_back({static_cast<std::uint32_t>(i),
                            {wall.points.row(i).transpose(), wall.normals.row(i).transpose()}});
  }
  bool is_red(Eigen::Index i) const { return wall.points(i, 0) > 0.24F; }
  std::size_t count_red(const std::vector<char>& chosen) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      count += chosen[i] != 0 && is_red(static_cast<Eigen::Index>(i));
    return count;
  }

  Cloud wall = test::detail::wall(1, 0.3F);
  std::vector<pairs::Reference> references;
};

std::shared_ptr<const pairs::PairTable> table_of(const Light* light) {
  Model model = *bumpy_model(1);
  if (light) model.cloud.colors = light->replicate(model.cloud.points.rows(), 1);
  return pairs::index_pairs(model, 0.07F * model.diagonal);
}

std::size_t count(const std::vector<char>& chosen) {
  return static_cast<std::size_t>(std::accumulate(chosen.begin(), chosen.end(), 0));
}

}  // namespace

TEST_CASE("pairs start where the colours are the object's", "[pairs][color]") {
  const Scene scene;
  const pairs::ColorChoice choice(scene.references, scene.wall, kResolution);
  const auto chosen = [&](const Light* light) { return choice.choose(*table_of(light), kMost); };
  const auto red = chosen(&kRed);
  REQUIRE(red.size() == scene.references.size());
  CHECK(count(red) == kMost);
  CHECK(scene.count_red(red) > kMost * 3 / 4);
  CHECK(scene.count_red(red) < kMost);  // the light may be another
  CHECK(scene.count_red(chosen(&kBlue)) < kMost / 20);
}

TEST_CASE("where colours do not tell, pairs start everywhere", "[pairs][color]") {
  const Scene scene;
  const pairs::ColorChoice choice(scene.references, scene.wall, kResolution);
  for (const Light* light : {&kGreen, static_cast<const Light*>(nullptr)}) {
    const auto chosen = choice.choose(*table_of(light), kMost);
    CHECK(count(chosen) == kMost);
    CHECK(scene.count_red(chosen) >= 5);
    CHECK(scene.count_red(chosen) <= 15);
  }
  CHECK(count(choice.choose(*table_of(&kRed), 0)) == 0);
  CHECK(count(choice.choose(*table_of(&kRed), 100000)) <= scene.references.size());
}

TEST_CASE("of no points none is chosen", "[pairs][color]") {
  const Scene scene;
  CHECK(pairs::ColorChoice({}, scene.wall, kResolution).choose(*table_of(&kRed), 10).empty());
}

}  // namespace posevote::color_choice_test
