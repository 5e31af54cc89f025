// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "graph/problem.hpp"
#include "nodes/data/cloud.hpp"
#include "pipelines/configuration.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::crop_box_test {

TEST_CASE("crop_box keeps what lies in the box, with its normals and the view", "[examples]") {
  Scan scan;
  scan.points.resize(3, 3);
  scan.points << 0, 0, 1, 0.9F, 0, 1, 0, 0, 5;
  scan.normals = -scan.points.rowwise().normalized();
  scan.view.pixels = {640, 480};
  const std::map<std::string, std::string> box{{"low", "[-0.5, -0.5, 0]"},
                                               {"high", "[0.5, 0.5, 2]"}};
  const auto cropped = test::run_node<Scan>("crop_box", box, scan);
  REQUIRE(cropped.points.rows() == 1);
  CHECK(cropped.points.row(0) == scan.points.row(0));
  CHECK(cropped.normals.row(0) == scan.normals.row(0));
  CHECK(cropped.view.pixels.x() == 640);
  CHECK_THROWS_WITH(test::run_node<Scan>("crop_box", {{"high", "[1, 1, 0.5]"}}, scan),
                    Catch::Contains("none of the scan's 3 points"));
}

TEST_CASE("a variant of the pipeline takes it in", "[examples]") {
  const test::TemporaryFolder folder;
  const auto variant = [&](const std::string& low) {
    return folder.write("cropped.yaml",
                        "extends: recognize\n"
                        "insert:\n"
                        "  crop_box: {into: scan, low: " +
                            low + "}\n");
  };
  const auto cropped = load_configuration(variant("[-1, -1, 0.2]"), {}).scenes;
  CHECK(cropped.nodes.size() == load_configuration("bop", {}).scenes.nodes.size() + 1);
  for (const graph::PlannedNode& node : cropped.nodes)
    for (const int input : node.inputs)
      CHECK((cropped.streams[std::size_t(input)].name == "scan") == (node.name == "crop_box"));
  CHECK_THROWS_WITH(load_configuration(variant("[-1, -1]"), {}),
                    Catch::Contains("must have three numbers each"));
}

}  // namespace posevote::crop_box_test
