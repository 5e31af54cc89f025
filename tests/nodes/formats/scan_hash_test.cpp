// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/scan_hash.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"

namespace posevote::scan_hash_test {

using posevote::test::TemporaryFolder;

TEST_CASE("a scan is told by its bytes and by the pose beside it, not by its name", "[formats]") {
  const TemporaryFolder folder;
  const auto hash = [](const std::filesystem::path& file) {
    return formats::hash_scan({file, 0, 0, {}});
  };
  const std::string a = hash(folder.write("a.ply", "points"));
  CHECK(a == hash(folder.write("b.ply", "points")));
  CHECK(a != hash(folder.write("c.ply", "Points")));
  folder.write("a.pose", "0 0 1");
  const std::string posed = hash(folder / "a.ply");
  CHECK(posed != a);
  folder.write("a.pose", "0 0 2");
  CHECK(posed != hash(folder / "a.ply"));
  const auto with_colors = [&] {
    return formats::hash_scan({folder / "b.ply", 0, 0, {}, {}, {}, folder / "b.png"});
  };
  CHECK_THROWS_WITH(with_colors(), Catch::Contains("b.png: cannot be opened"));
  folder.write("b.png", "red");
  const std::string red = with_colors();
  CHECK(red != a);
  folder.write("b.png", "green");
  CHECK(red != with_colors());
  SceneFile in_memory{folder / "nowhere.ply", 0, 0, {}};
  in_memory.depth = std::make_shared<const LoadedDepth>();
  CHECK(formats::hash_scan(in_memory).empty());
}

}  // namespace posevote::scan_hash_test
