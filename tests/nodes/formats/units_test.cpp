// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/units.hpp"

#include <stdexcept>

#include "tests/nodes/formats/support.hpp"

using namespace posevote;

TEST_CASE("units of length", "[formats]") {
  CHECK(formats::metres_per("mm") == 0.001);
  CHECK(formats::metres_per("cm") == 0.01);
  CHECK(formats::metres_per("m") == 1);
  CHECK(formats::metres_per("in") == 0.0254);
  CHECK_THROWS_AS(formats::metres_per("mile"), std::invalid_argument);
  for (const std::string& unit : formats::length_units()) CHECK(formats::metres_per(unit) > 0);
}
