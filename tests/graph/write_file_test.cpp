// SPDX-License-Identifier: BSD-3-Clause
#include "graph/write_file.hpp"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace posevote::write_file_test {

using Catch::Contains;
using graph::write_durably;
using graph::write_file;
using test::read_text;
namespace fs = std::filesystem;

namespace {

/// As on a full disk: no file grows beyond `bytes` while it lives.
struct SmallDisk {
  explicit SmallDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before); }
  rlimit before{};
};

}  // namespace

TEST_CASE("a file is written whole or stays as it was", "[write_file]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "a.txt";
  write_file(file, "old");
  {
    const SmallDisk disk(100);
    CHECK_THROWS_WITH(write_file(file, std::string(1000, 'x')),
                      Contains("a.txt: cannot be written: File too large"));
  }
  CHECK(read_text(file) == "old");
  write_file(file, "new");
  CHECK(read_text(file) == "new");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);  // nothing left beside it
}

TEST_CASE("what is to outlast a loss of power is written the same way", "[write_file]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "a.txt";
  write_durably(file, "old");
  {
    const SmallDisk disk(100);
    CHECK_THROWS_WITH(write_durably(file, std::string(1000, 'x')), Contains("a.txt: cannot be"));
  }
  CHECK(read_text(file) == "old");
}

TEST_CASE("links lead to what is written, and what is no plain file stays what it is",
          "[write_file]") {
  const test::TemporaryFolder folder;
  folder.write("target.txt", "old");
  fs::create_symlink("target.txt", folder / "link.txt");
  write_file(folder / "link.txt", "new");
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(read_text(folder / "target.txt") == "new");
  write_file("/dev/null", "anything");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_WITH(write_file("/dev/full", "x"), Contains("No space left on device"));
  CHECK_THROWS_WITH(write_file(folder.path(), "x"), Contains("is a folder"));
  CHECK_THROWS_WITH(write_file(folder / "no/where", "x"),
                    Contains("no/where: cannot be written: No such file or directory"));
  fs::create_symlink("loop", folder / "loop");
  CHECK_THROWS_WITH(write_file(folder / "loop", "x"), Contains("loop: cannot be written: "));
}

TEST_CASE("what a killed process left of a file is taken away, and nothing else", "[write_file]") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.ply.1f2e.tmp", "a.tmp", "a.ply.scan.tmp", "1f2e.tmp", "a.1f2e"})
    folder.write(name, "x");
  graph::remove_unfinished(folder.path());
  CHECK_FALSE(fs::exists(folder / "a.ply.1f2e.tmp"));
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 4);
  CHECK_NOTHROW(graph::remove_unfinished(folder / "none"));
}

}  // namespace posevote::write_file_test
