// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/color/srgb.hpp"

#include <catch2/catch.hpp>
#include <limits>

namespace posevote::srgb_test {

TEST_CASE("bytes become light and come back", "[color]") {
  for (int value = 0; value < 256; ++value)
    CHECK(color::byte_of(color::linear_of(static_cast<std::uint8_t>(value))) == value);
  CHECK(color::linear_of(std::uint8_t{188}) == Approx(0.5).margin(0.005));  // half the light
  CHECK(color::linear_of(188 / 255.0) == Approx(color::linear_of(std::uint8_t{188})));
  CHECK(color::linear_of(std::numeric_limits<double>::quiet_NaN()) == 0);
  CHECK(color::byte_of(7) == 255);
  CHECK(color::byte_of(-1) == 0);
}

TEST_CASE("CIELAB of colours whose values are known", "[color]") {
  ColorMatrix colors(4, 3);
  colors << 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  const PointMatrix lab = color::lab_of(colors);
  CHECK(lab.row(0).isApprox(Eigen::RowVector3f(100, 0, 0), 1e-3F));
  CHECK(lab.row(1).norm() == Approx(0).margin(1e-3));
  CHECK((lab.row(2) - Eigen::RowVector3f(53.24F, 80.09F, 67.2F)).norm() < 0.2F);  // red
  CHECK((lab.row(3) - Eigen::RowVector3f(32.3F, 79.19F, -107.86F)).norm() < 0.2F);
}

}  // namespace posevote::srgb_test
