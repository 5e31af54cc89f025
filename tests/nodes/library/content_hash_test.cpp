// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/content_hash.hpp"

#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"

namespace posevote::content_hash_test {

using namespace posevote::test;
namespace fs = std::filesystem;

TEST_CASE("the hash of files depends on every byte, the order and the parameters", "[match]") {
  const TemporaryFolder folder;
  const fs::path a = folder.write("a", "ab"), b = folder.write("b", "c");
  const fs::path c = folder.write("c", "a"), d = folder.write("d", "bc");
  const std::string hash = library::hash_files({a, b}, "x");
  CHECK(hash.size() == 32);
  CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(hash == library::hash_files({a, b}, "x"));
  CHECK(hash != library::hash_files({b, a}, "x"));
  CHECK(hash != library::hash_files({a, b}, "y"));
  CHECK(hash != library::hash_files({c, d}, "x"));
  CHECK(hash != library::hash_files({a}, "cx"));
  CHECK(library::hash_files({}, "") != library::hash_files({}, "x"));
  CHECK_THROWS_WITH(library::hash_files({folder / "none"}, ""),
                    Catch::Contains("none: cannot be opened"));
  CHECK_THROWS_WITH(library::hash_files({folder.path()}, ""), Catch::Contains("cannot be opened"));
}

TEST_CASE("the hash of a large file covers all of it", "[match]") {
  const TemporaryFolder folder;
  std::string text(300000, 'x');
  const std::string hash = library::hash_files({folder.write("a", text)}, "");
  text.back() = 'y';
  CHECK(hash != library::hash_files({folder.write("a", text)}, ""));
}

}  // namespace posevote::content_hash_test
