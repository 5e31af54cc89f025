// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/color/color_shares.hpp"

#include <catch2/catch.hpp>

namespace posevote::color_shares_test {

TEST_CASE("shares of colours are those of about such colours", "[color]") {
  PointMatrix lab(4, 3);
  lab << 50, 0, 0,  //
      52, 3, -2,    //
      48, 60, 40,   //
      47, -300, 900;
  const color::ColorShares shares(lab);
  CHECK(shares.like({50, 0, 0}) == 0.5F);
  CHECK(shares.like({58, 6, 4}) == 0.5F);  // other light, or a cast
  CHECK(shares.like({50, 55, 45}) == 0.25F);
  CHECK(shares.like({50, -60, 0}) == 0);
  CHECK(shares.like({50, -500, 500}) == 0.25F);  // what is beyond lies in the outermost bin
}

TEST_CASE("nothing has no colours", "[color]") {
  CHECK(color::ColorShares().like({50, 0, 0}) == 0);
  CHECK(color::ColorShares(PointMatrix(0, 3)).like({50, 0, 0}) == 0);
}

}  // namespace posevote::color_shares_test
