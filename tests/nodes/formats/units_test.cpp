// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/units.hpp"

#include <stdexcept>

#include "tests/nodes/formats/support.hpp"

namespace posevote::units_test {

TEST_CASE("units of length", "[formats]") {
  CHECK(formats::metres_per("mm") == 0.001);
  CHECK(formats::metres_per("cm") == 0.01);
  CHECK(formats::metres_per("m") == 1);
  CHECK(formats::metres_per("in") == 0.0254);
  CHECK_THROWS_AS(formats::metres_per("mile"), std::invalid_argument);
  for (const std::string& unit : formats::length_units()) CHECK(formats::metres_per(unit) > 0);
}

TEST_CASE("the unit that would fit", "[formats]") {
  const auto is = [](double size, const std::string& read_as = "") {
    const auto mistake = formats::unit_mistake(size, 0.1, 1, read_as);
    return mistake ? mistake->is + " as " + mistake->read_as : "";
  };
  CHECK(is(0.2) == "");
  CHECK(is(200) == "mm as m");
  CHECK(is(0.0002) == "m as mm");
  CHECK(is(15) == "cm as m");
  CHECK(is(0.02) == "cm as mm");
  CHECK(is(0.02, "mm") == "cm as mm");
  CHECK(is(5, "cm") == "mm as cm");
  CHECK(is(1e9) == "");
  CHECK(is(200, "mm") == "");
}

TEST_CASE("models of sizes that no object has", "[formats]") {
  for (const double diagonal : {0.002, 0.1, 15.0})
    CHECK(formats::odd_model_size(diagonal, "m") == "");
  CHECK_THAT(formats::odd_model_size(100, "m"),
             test::has("diagonal is 100 m, read as m: is it in mm? Say --model-unit mm"));
  CHECK_THAT(formats::odd_model_size(0.00025, "mm"), test::has("is it in m? Say --model-unit m "));
  CHECK_THAT(formats::odd_model_size(1e6, "m"), test::has("check --model-unit"));
}

TEST_CASE("the unit that a file is likely in", "[formats]") {
  const auto unit = [](double size) { return formats::likely_unit(size, 10).unit; };
  CHECK(unit(0.2) == "m");
  CHECK(unit(9.9) == "m");
  CHECK(unit(10) == "mm");
  CHECK(unit(300) == "mm");
  for (const double clear : {0.2, 3.0, 30.0, 300.0})
    CHECK(formats::likely_unit(clear, 10).doubt == "");
  CHECK_THAT(formats::likely_unit(4, 10).doubt, test::has("4 could be mm or m: read as m"));
  CHECK_THAT(formats::likely_unit(29, 10).doubt, test::has("29 could be mm or m: read as mm"));
}

}  // namespace posevote::units_test
