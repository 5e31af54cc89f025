// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/raw_mesh.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::read_off_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

std::string off_error(const std::string& bytes) {
  return error_of([&] { read_raw(".off", bytes); });
}

const std::string kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("OFF: counts, comments, polygons and face colours", "[load][off]") {
  const formats::RawMesh mesh = read_raw(".off", "OFF # a square\n\n# counts\n4 2 0\n" + kSquare +
                                                     "4 0 1 2 3 255 0 0 # red\n3 0 1 3\n");
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.points[2] == formats::Triple{1, 1, 0});
  REQUIRE(mesh.faces.size() == 3);
  CHECK(mesh.faces[1] == std::array<std::uint32_t, 3>{0, 2, 3});
}

TEST_CASE("OFF: the counts may stand in the keyword's line", "[load][off]") {
  CHECK(read_raw(".off", "OFF4 1 0\n" + kSquare + "3 0 1 2\n").faces.size() == 1);
  CHECK(read_raw(".off", "OFF 4 1 0\n" + kSquare + "3 0 1 2\n").faces.size() == 1);
}

TEST_CASE("OFF: normals and colours", "[load][off]") {
  const formats::RawMesh normals = read_raw(".off", "NOFF\n1 0 0\n1 2 3 0 0 1\n");
  CHECK(normals.normals == std::vector<formats::Triple>{{0, 0, 1}});
  CHECK(read_raw(".off", "COFF\n1 0 0\n1 2 3 255 0 0 255\n").points.size() == 1);
  CHECK(read_raw(".off", "CNOFF\n1 0\n1 2 3 0 1 0 255 0 0 255\n").normals[0] ==
        formats::Triple{0, 1, 0});
}

TEST_CASE("OFF: damage", "[load][off]") {
  CHECK_THAT(off_error("solid cube"), has("starts with 'solid cube'"));
  CHECK_THAT(off_error("4OFF\n1 0 0\n"), has("not supported"));
  CHECK_THAT(off_error("OFF BINARY\n"), has("binary OFF is not supported"));
  CHECK_THAT(off_error("OFF\n"), has("ends before the counts"));
  CHECK_THAT(off_error("OFF\n4 x 0\n"), has("line 2: expected the number of faces"));
  CHECK_THAT(off_error("OFF\n4000000000 1 0\n" + kSquare + "3 0 1 2\n"),
             has("claims 4000000000 vertices, the file has room for at most 5"));
  CHECK_THAT(off_error("OFF99999999999999999 1 0\n" + kSquare), has("99999999999999999"));
  CHECK_THAT(off_error("OFF\n4 4000000000 0\n" + kSquare + "3 0 1 2\n"),
             has("claims 4000000000 faces"));
  CHECK_THAT(off_error("OFF\n4 1 0\n" + kSquare.substr(0, 23) + "      \n"),
             has("after line 6, expected face 1 of 1"));
  CHECK_THAT(off_error("OFF\n4 1 0\n" + kSquare + "3 0 1 4\n"), has("line 7: a face refers to"));
  CHECK_THAT(off_error("OFF\n4 1 0\n" + kSquare + "3 0 1\n"), has("line 7: ends where"));
  CHECK_THAT(off_error("OFF\n4 1 0\n" + kSquare + "4294967296 0 1\n"), has("line 7: ends where"));
  CHECK_THAT(off_error("OFF\n3 1 0\n" + kSquare + "3 0 1 2\n"), has("line 7: more"));
  CHECK_THAT(off_error("OFF\n1 0 0\n1 2 3 4\n"), has("line 3: more than 3 numbers"));
}

}  // namespace posevote::read_off_test
