// SPDX-License-Identifier: BSD-3-Clause
#include "graph/output_file.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace posevote::output_file_test {

using Catch::Contains;
using graph::OutputFile;
using graph::sync_file;
using test::read_text;

TEST_CASE("a file is begun anew, gone on with, and cut", "[output_file]") {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.txt", "of before");
  OutputFile anew(file, OutputFile::Start::kAnew);
  anew.write("one ");
  anew.write("two");
  anew.sync();
  CHECK(read_text(file) == "one two");
  anew.close();
  OutputFile there(file, OutputFile::Start::kThere);
  there.write_at(4, "2 three");
  there.cut(5);
  there.close();
  CHECK(read_text(file) == "one 2");
}

TEST_CASE("a file that cannot be written is named with the cause", "[output_file]") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(OutputFile(folder / "none", OutputFile::Start::kThere),
                    Contains("none: cannot be written: No such file or directory"));
  CHECK_THROWS_WITH(OutputFile(folder / "no/where", OutputFile::Start::kAnew, "another"),
                    Contains("another: cannot be written: No such file or directory"));
  OutputFile full("/dev/full", OutputFile::Start::kAnew);
  CHECK_THROWS_WITH(full.write("x"), "/dev/full: cannot be written: No space left on device");
}

TEST_CASE("files and folders are put on the disk", "[output_file]") {
  const test::TemporaryFolder folder;
  CHECK_NOTHROW(sync_file(folder.write("a.txt", "a")));
  CHECK_NOTHROW(sync_file(folder.path()));
  CHECK_NOTHROW(sync_file("/dev/null"));  // knows no such thing
  CHECK_THROWS_WITH(sync_file(folder / "none"), Contains("none: cannot be written: No such file"));
}

}  // namespace posevote::output_file_test
