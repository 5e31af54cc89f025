// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/content_hash.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"

using namespace posevote;
using namespace posevote::test;
namespace fs = std::filesystem;

TEST_CASE("the hash of files depends on every byte, the order and the parameters", "[match]") {
  const TemporaryFolder folder;
  const fs::path a = folder.write("a", "ab"), b = folder.write("b", "c");
  const fs::path c = folder.write("c", "a"), d = folder.write("d", "bc");
  const std::string hash = formats::hash_files({a, b}, "x");
  CHECK(hash.size() == 32);
  CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(hash == formats::hash_files({a, b}, "x"));
  CHECK(hash != formats::hash_files({b, a}, "x"));
  CHECK(hash != formats::hash_files({a, b}, "y"));
  CHECK(hash != formats::hash_files({c, d}, "x"));
  CHECK(hash != formats::hash_files({a}, "cx"));
  CHECK(formats::hash_files({}, "") != formats::hash_files({}, "x"));
  CHECK_THROWS_WITH(formats::hash_files({folder / "none"}, ""),
                    Catch::Contains("none: cannot be opened"));
  CHECK_THROWS_WITH(formats::hash_files({folder.path()}, ""), Catch::Contains("cannot be opened"));
}

TEST_CASE("the hash of a large file covers all of it", "[match]") {
  const TemporaryFolder folder;
  std::string text(300000, 'x');
  const std::string hash = formats::hash_files({folder.write("a", text)}, "");
  text.back() = 'y';
  CHECK(hash != formats::hash_files({folder.write("a", text)}, ""));
}

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
  SceneFile in_memory{folder / "nowhere.ply", 0, 0, {}};
  in_memory.depth = std::make_shared<const LoadedDepth>();
  CHECK(formats::hash_scan(in_memory).empty());
}
