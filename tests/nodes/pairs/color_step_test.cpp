// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/color_step.hpp"

#include <catch2/catch.hpp>

#include "nodes/color/srgb.hpp"

namespace posevote::color_step_test {
namespace {

Eigen::Vector3f lab(float red, float green, float blue) {
  ColorMatrix color(1, 3);
  color << red, green, blue;
  return color::lab_of(color).row(0).transpose();
}

bool alike(std::uint8_t one, std::uint8_t other) { return pairs::like_steps(one)[other] == 1; }

}  // namespace

TEST_CASE("a change of colour is like itself and unlike its opposite", "[pairs]") {
  const Eigen::Vector3f red = lab(0.5F, 0.05F, 0.05F), blue = lab(0.05F, 0.1F, 0.6F);
  const std::uint8_t there = pairs::color_step(red, blue), back = pairs::color_step(blue, red);
  CHECK(alike(there, there));
  CHECK(alike(back, back));
  CHECK(!alike(there, back));
  CHECK(!alike(there, pairs::color_step(red, red)));
  for (int step = 0; step < 256; ++step)
    for (int other = 0; other < 256; ++other)
      CHECK(alike(static_cast<std::uint8_t>(step), static_cast<std::uint8_t>(other)) ==
            alike(static_cast<std::uint8_t>(other), static_cast<std::uint8_t>(step)));
}

TEST_CASE("light and noise do not make another change of colour", "[pairs]") {
  const Eigen::Vector3f red = lab(0.5F, 0.05F, 0.05F), green = lab(0.1F, 0.4F, 0.1F);
  const std::uint8_t step = pairs::color_step(red, green);
  CHECK(alike(step, pairs::color_step(lab(0.35F, 0.035F, 0.035F), lab(0.07F, 0.28F, 0.07F))));
  const Eigen::Vector3f noise(4, -3, 3);
  CHECK(alike(step, pairs::color_step(red + noise, green - noise)));
}

TEST_CASE("colours beyond all levels are told as the last", "[pairs]") {
  const Eigen::Vector3f far(500, 500, -500), near(0, 0, 0);
  CHECK(alike(pairs::color_step(near, far), pairs::color_step(near, 2 * far)));
}

}  // namespace posevote::color_step_test
