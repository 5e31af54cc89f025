// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/models_info.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"

namespace posevote::models_info_test {

using Catch::Contains;
using posevote::test::TemporaryFolder;

namespace {

std::map<int, Symmetries> read(const std::string& models_info) {
  const TemporaryFolder folder;
  folder.write("models_info.json", models_info);
  return layouts::known_symmetries(folder / "models_info.json");
}

}  // namespace

TEST_CASE("a half turn listed in mm stays about its own axis in metres", "[dataset]") {
  // about z through x = 10 mm, y = 20 mm
  const auto known = read(R"({"3": {"diameter": 90, "symmetries_discrete":
      [[-1, 0, 0, 20, 0, -1, 0, 40, 0, 0, 1, 0, 0, 0, 0, 1]]}, "4": {"diameter": 90}})");
  REQUIRE(known.size() == 1);
  const Symmetries& found = known.at(3);
  REQUIRE(found.turns.size() == 2);
  CHECK(found.turns[0].isApprox(Eigen::Quaternionf::Identity()));
  CHECK(std::abs(found.turns[1].z()) == Approx(1));
  CHECK(found.fixed_point.isApprox(Eigen::Vector3f(0.01F, 0.02F, 0), 1e-5F));
  CHECK(found.axes.empty());
}

TEST_CASE("a can's axis has a direction and a place; an empty list says there is none",
          "[dataset]") {
  const auto known = read(R"({"1": {"symmetries_continuous": [{"axis": [0, 2, 0],
      "offset": [5, 0, 7]}]}, "2": {"symmetries_discrete": []}})");
  REQUIRE(known.size() == 2);
  REQUIRE(known.at(1).axes.size() == 1);
  CHECK(known.at(1).axes[0].isApprox(Eigen::Vector3f::UnitY()));
  CHECK(known.at(1).fixed_point.isApprox(Eigen::Vector3f(0.005F, 0, 0.007F)));
  CHECK_FALSE(known.at(2).any());
}

TEST_CASE("what is wrong with listed symmetries is told with file and object", "[dataset]") {
  CHECK(layouts::known_symmetries("/nowhere/models_info.json").empty());
  CHECK_THROWS_WITH(read(R"({"12": {"symmetries_discrete": [[1, 0, 0]]}})"),
                    Contains("models_info.json: object 12") && Contains("3 numbers, expected 16"));
  CHECK_THROWS_WITH(read(R"({"12": {"symmetries_continuous": [{"axis": [0, 0, 0]}]}})"),
                    Contains("object 12") && Contains("no direction"));
  CHECK_THROWS_WITH(read(R"({"12": {"symmetries_continuous": [{"offset": [0, 0, 0]}]}})"),
                    Contains("object 12") && Contains("axis"));
  CHECK_THROWS_WITH(read("[1]"), Contains("is no JSON object"));
  CHECK_THROWS_WITH(read(R"({"12": 5})"), Contains("object 12"));
  CHECK_THROWS_WITH(read(R"({"can": {}})"), Contains("models_info.json: \"can\" is no obj_id"));
}

}  // namespace posevote::models_info_test
