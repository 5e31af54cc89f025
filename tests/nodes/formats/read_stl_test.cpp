// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/raw_mesh.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::read_stl_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

using Face = std::array<std::uint32_t, 3>;

std::string stl_error(const std::string& bytes) {
  return error_of([&] { read_raw(".stl", bytes); });
}

/// Two triangles that share an edge.
std::string binary_square(const std::string& title = "made by a test", std::uint32_t count = 2) {
  std::string bytes = title;
  bytes.resize(80, '\0');
  append(bytes, count);
  const float corners[2][4][3] = {{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                  {{0, 0, 1}, {-0.0F, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (const auto& triangle : corners) {
    for (const auto& vector : triangle)
      for (const float value : vector) append(bytes, value);
    append<std::uint16_t>(bytes, 0xffff);
  }
  return bytes;
}

const std::string kFacet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n"
    "      vertex 1 1 0\n    endloop\n  endfacet\n";
const std::string kOther =
    "FACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 1 0 VERTEX 0 1 0 ENDLOOP ENDFACET\r\n";

}  // namespace

TEST_CASE("STL: faces share the vertices at the same place", "[load][stl]") {
  for (const std::string& bytes :
       {binary_square(), binary_square("solid but binary"), binary_square() + "\n",
        "solid a square\n" + kFacet + kOther + "endsolid a square\n",
        "solid one\n" + kFacet + "endsolid one\nsolid two\n" + kOther + "endsolid\n"}) {
    const formats::RawMesh mesh = read_raw(".stl", bytes);
    CHECK(mesh.points == std::vector<formats::Triple>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    REQUIRE(mesh.faces.size() == 2);
    CHECK(mesh.faces[0] == Face{0, 1, 2});
    CHECK(mesh.faces[1] == Face{0, 2, 3});
    CHECK(mesh.normals.empty());
  }
}

TEST_CASE("STL: binary cut off anywhere is an error", "[load][stl]") {
  const std::string whole = binary_square();
  for (std::size_t size = 0; size < whole.size(); ++size)
    CHECK(stl_error(whole.substr(0, size)) != "(no error)");
}

TEST_CASE("STL: ascii cut off before its end is an error", "[load][stl]") {
  const std::string whole = "solid a\n" + kFacet + kOther + "endsolid";
  for (std::size_t size = 0; size < whole.size(); ++size)
    CHECK(stl_error(whole.substr(0, size)) != "(no error)");
}

TEST_CASE("STL: damage", "[load][stl]") {
  CHECK_THAT(stl_error("Dear Sir"), has("not an STL file: starts with 'Dear Sir'"));
  CHECK_THAT(stl_error(binary_square("x", 4000000000U)),
             has("its 4000000000 triangles take 200000000084 bytes, the file has 184"));
  CHECK_THAT(stl_error(binary_square("x", 1)), has("its 1 triangles take 134 bytes"));
  CHECK_THAT(stl_error("solid a\n" + kFacet + "vertex\n"),
             has("line 9: expected facet or endsolid, found 'vertex'"));
  CHECK_THAT(stl_error("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
             has("line 4: ends where a number was expected"));
  CHECK_THAT(stl_error("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n"),
             has("line 5: expected vertex, found 'endloop'"));
  CHECK_THAT(stl_error("solid a\n" + kFacet), has("ends after line 8, before endsolid"));
}

}  // namespace posevote::read_stl_test
