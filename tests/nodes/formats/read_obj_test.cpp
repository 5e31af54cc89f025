// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/raw_mesh.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::read_obj_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

using Face = std::array<std::uint32_t, 3>;

std::string obj_error(const std::string& bytes) {
  return error_of([&] { read_raw(".obj", bytes); });
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: every form of a face", "[load][obj]") {
  const formats::RawMesh mesh =
      read_raw(".obj", "# made by a test\r\nmtllib a.mtl\r\no square\n" + kSquare +
                           "vt 0 0\nvn 0 0 2\ns off\nusemtl red\n"
                           "f 1 2 3 4\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1 # with normals\n"
                           "f -4/-1/-1 -3/1/1 -1/1/-1\n");
  CHECK(mesh.points.size() == 4);
  REQUIRE(mesh.faces.size() == 5);
  CHECK(mesh.faces[0] == Face{0, 1, 2});
  CHECK(mesh.faces[1] == Face{0, 2, 3});
  CHECK(mesh.faces[3] == Face{0, 1, 2});
  CHECK(mesh.faces[4] == Face{0, 1, 3});
  REQUIRE(mesh.normals.size() == 4);
  CHECK(mesh.normals[2] == formats::Triple{0, 0, 2});
}

TEST_CASE("OBJ: negative indices count from the latest vertex at that line", "[load][obj]") {
  const formats::RawMesh mesh = read_raw(".obj", kSquare + "f -4 -3 -2\nv 5 5 5\nf -1 1 2\n");
  CHECK(mesh.faces[0] == Face{0, 1, 2});
  CHECK(mesh.faces[1] == Face{4, 0, 1});
}

TEST_CASE("OBJ: a long face goes on in the next line", "[load][obj]") {
  const formats::RawMesh mesh = read_raw(".obj", kSquare + "f 1 2 \\\r\n  3 \\\n4\nf 1 2 3\n");
  CHECK(mesh.faces == std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
  CHECK_THAT(obj_error(kSquare + "f 1 2 3 \\\n"), has("line 5: the file ends within a face"));
  CHECK_THAT(obj_error(kSquare + "f 1 2 \\\n 3\nf 1 9 2\n"),
             has("line 7: a face refers to vertex 9"));
}

TEST_CASE("OBJ: normals", "[load][obj]") {
  SECTION("of a vertex whose corners differ: their mean") {
    const formats::RawMesh mesh =
        read_raw(".obj", kSquare + "vn 1 0 0\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n");
    CHECK(mesh.normals[0] == formats::Triple{1, 1, 0});
  }
  SECTION("as many as vertices, without faces: in order") {
    const formats::RawMesh mesh = read_raw(".obj", "v 0 0 0\nvn 1 0 0\nv 1 0 0\nvn 0 1 0\n");
    CHECK(mesh.normals == std::vector<formats::Triple>{{1, 0, 0}, {0, 1, 0}});
  }
  SECTION("more than vertices, without faces: unusable") {
    CHECK(read_raw(".obj", "v 0 0 0\nvn 1 0 0\nvn 0 1 0\n").normals.empty());
  }
}

TEST_CASE("OBJ: a vertex may follow its face, and have a weight or a colour", "[load][obj]") {
  const formats::RawMesh mesh =
      read_raw(".obj", "f 1 2 3\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\n");
  CHECK(mesh.points[1] == formats::Triple{1, 0, 0});
  CHECK(mesh.faces[0] == Face{0, 1, 2});
}

TEST_CASE("OBJ: damage names its line", "[load][obj]") {
  CHECK_THAT(obj_error("Hello\n"), has("line 1: expected a line of an OBJ file, found 'Hello'"));
  CHECK_THAT(obj_error(kSquare + "v 1 2\n"), has("line 5: ends where a number was expected"));
  CHECK_THAT(obj_error(kSquare + "f 1 2 5\n"),
             has("line 5: a face refers to vertex 5, the file has 4"));
  CHECK_THAT(obj_error(kSquare + "f 1 2 4294967295\n"), has("vertex 4294967295"));
  CHECK_THAT(obj_error(kSquare + "f 1 2 4294967297\n"), has("line 5: expected an index"));
  CHECK_THAT(obj_error(kSquare + "f 1 2 0\n"), has("found '0'"));
  CHECK_THAT(obj_error(kSquare + "f 1 2 -5\n"), has("down to -4, found '-5'"));
  CHECK_THAT(obj_error(kSquare + "f 1 2\n"), has("line 5: a face needs three corners"));
  CHECK_THAT(obj_error(kSquare + "f 1//1 2//1 3//1\n"), has("normal 1, the file has 0"));
  CHECK_THAT(obj_error(kSquare + "f 1// 2 3\n"), has("found ''"));
}

}  // namespace posevote::read_obj_test
