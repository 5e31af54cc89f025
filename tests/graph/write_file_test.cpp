// SPDX-License-Identifier: BSD-3-Clause
#include "graph/write_file.hpp"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

using namespace posevote;
using Catch::Contains;
using graph::sync_file;
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
  CHECK_NOTHROW(sync_file(file));
  CHECK_NOTHROW(sync_file(folder.path()));
  CHECK_THROWS_WITH(sync_file(folder / "none"), Contains("none: cannot be written: No such file"));
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
  CHECK_THAT(graph::cause_of(0), !Contains("Success"));
}
