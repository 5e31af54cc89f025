// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/formats/read_scan.hpp"
#include "pipelines/inputs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::read_xyz_test {

TEST_CASE("XYZ files are scans like others", "[examples]") {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.xyz", "# mm\n1000 0 500 17\n\n 0 2000 -1e3\n");
  const Scan scan = formats::read_scan(file, 0.001);
  REQUIRE(scan.points.rows() == 2);
  CHECK(scan.points(0, 2) == Approx(0.5));
  CHECK(scan.points(1, 1) == Approx(2));
  CHECK(list_scenes({folder.path().string()}).size() == 1);
  CHECK_THROWS_WITH(formats::read_scan(folder.write("b.xyz", "1 2 3\n1 2\n"), 1),
                    Catch::Contains("line 2: expected x y z"));
}

}  // namespace posevote::read_xyz_test
