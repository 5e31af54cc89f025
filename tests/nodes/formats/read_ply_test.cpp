// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdlib>
#include <random>

#include "nodes/formats/raw_mesh.hpp"
#include "nodes/formats/read_scan.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::read_ply_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

std::string ply_error(const std::string& bytes) {
  return error_of([&] { read_raw(".ply", bytes); });
}

std::string vertex_header(const std::string& count, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\n";
}

const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

/// A vertex row with a value of every type, a list in the middle and the coordinates out of order;
/// an element nobody knows before the vertices; faces with a list and a scalar beside the indices.
struct MixedFile {
  std::vector<formats::Triple> points;
  std::string header, body;

  explicit MixedFile(std::endian order) {
    const bool little = order == std::endian::little;
    header = "ply\r\nformat binary_" + std::string(little ? "little" : "big") +
             "_endian 1.0\r\ncomment made by a test\r\nobj_info none\r\n"
             "element camera 2\r\nproperty uchar kind\r\nproperty list ushort float64 data\r\n"
             "element vertex 40\r\nproperty int8 a\r\nproperty double z\r\nproperty uint16 b\r\n"
             "property list int16 uint32 extra\r\nproperty float32 x\r\nproperty short c\r\n"
             "property int y\r\nproperty uint d\r\n"
             "element face 20\r\nproperty uint8 flag\r\nproperty list uint8 ushort vertex_index\r\n"
             "property list int float uv\r\nend_header\r\n";
    std::mt19937 random(5);
    const auto draw = [&random](int high) { return static_cast<int>(random() % unsigned(high)); };
    for (int i = 0; i < 2; ++i) {
      append<std::uint8_t>(body, 7);
      append<std::uint16_t>(body, 2, order);
      append(body, 1.5, order);
      append(body, 2.5, order);
    }
    for (int i = 0; i < 40; ++i) {
      const formats::Triple p{static_cast<float>(draw(1000)) / 7.0F,
                              static_cast<double>(draw(100) - 50), draw(1000) / 3.0};
      points.push_back(p);
      append<std::int8_t>(body, -3);
      append(body, p[2], order);
      append<std::uint16_t>(body, 60000, order);
      append(body, static_cast<std::int16_t>(i % 3), order);
      for (int k = 0; k < i % 3; ++k) append<std::uint32_t>(body, 4000000000U, order);
      append(body, static_cast<float>(p[0]), order);
      append<std::int16_t>(body, -300, order);
      append(body, static_cast<std::int32_t>(p[1]), order);
      append<std::uint32_t>(body, 1, order);
    }
    for (int i = 0; i < 20; ++i) {
      append<std::uint8_t>(body, 1);
      append<std::uint8_t>(body, 3);
      for (int k = 0; k < 3; ++k) append(body, static_cast<std::uint16_t>(i + k), order);
      append<std::int32_t>(body, 1, order);
      append(body, 0.5F, order);
    }
  }
};

}  // namespace

TEST_CASE("PLY: ascii points, normals and polygons", "[load][ply]") {
  const formats::RawMesh mesh = read_raw(
      ".ply",
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float nz\nproperty float x\n"
      "property float y\nproperty uchar red\nproperty float z\nproperty float nx\n"
      "property float ny\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0.5 1 2 255 3 6 7\n0.5 +1e1 -2.5E-1 0 .5 6 7\n0.5 nan inf 0 -inf 6 7\n"
      "\n0.5 4 4 0 4 6 7 \n0.5 5 5 0 5 6 7\t\r\n4 0 1 3 4\n3 4 3 0");
  REQUIRE(mesh.points.size() == 5);
  CHECK(mesh.points[0] == formats::Triple{1, 2, 3});
  CHECK(mesh.points[1] == formats::Triple{10, -0.25, 0.5});
  CHECK(std::isnan(mesh.points[2][0]));
  CHECK(mesh.points[2][2] == -HUGE_VAL);
  CHECK(mesh.normals[4] == formats::Triple{6, 7, 0.5});
  REQUIRE(mesh.faces.size() == 3);
  CHECK(mesh.faces[1] == std::array<std::uint32_t, 3>{0, 3, 4});
  CHECK(mesh.faces[2] == std::array<std::uint32_t, 3>{4, 3, 0});
}

TEST_CASE("PLY: binary of both orders, any types, extra elements and lists", "[load][ply]") {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const MixedFile file(order);
    const formats::RawMesh mesh = read_raw(".ply", file.header + file.body);
    CHECK(mesh.points == file.points);
    CHECK(mesh.normals.empty());
    REQUIRE(mesh.faces.size() == 20);
    CHECK(mesh.faces[19] == std::array<std::uint32_t, 3>{19, 20, 21});
  }
}

TEST_CASE("PLY: coordinates of every type", "[load][ply]") {
  const auto read_x = [](const std::string& type, auto value) {
    std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty " + type +
                        " x\nproperty char y\nproperty char z\nend_header\n";
    append(bytes, value, std::endian::big);
    const formats::RawMesh mesh = read_raw(".ply", bytes + "ab");
    REQUIRE(mesh.points.size() == 1);
    CHECK(mesh.points[0][2] == 'b');
    return mesh.points[0][0];
  };
  CHECK(read_x("char", std::int8_t{-7}) == -7);
  CHECK(read_x("uint8", std::uint8_t{200}) == 200);
  CHECK(read_x("int16", std::int16_t{-700}) == -700);
  CHECK(read_x("ushort", std::uint16_t{60000}) == 60000);
  CHECK(read_x("int", std::int32_t{-70000}) == -70000);
  CHECK(read_x("uint32", std::uint32_t{4000000000}) == 4e9);
  CHECK(read_x("float32", 0.5F) == 0.5);
  CHECK(read_x("double", 0.25) == 0.25);
}

TEST_CASE("PLY: binary cut off anywhere is an error", "[load][ply]") {
  const MixedFile file(std::endian::big);
  const std::string whole = file.header + file.body;
  for (std::size_t size = 0; size < whole.size(); ++size)
    CHECK(ply_error(whole.substr(0, size)) != "(no error)");
  CHECK_THAT(ply_error(whole.substr(0, whole.size() - 3)), has("within face 20 of 20"));
  CHECK_THAT(ply_error(whole.substr(0, whole.size() - 3)),
             has("ends at byte " + std::to_string(whole.size() - 3)));
  CHECK(read_raw(".ply", whole + "\n").points.size() == 40);
  CHECK_THAT(ply_error(whole + "abc"), has("3 bytes more"));
}

TEST_CASE("PLY: faces before vertices, faces without indices, no faces", "[load][ply]") {
  const formats::RawMesh early = read_raw(
      ".ply", "ply\nformat ascii 1.0\n" + kFaces +
                  "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                  "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  CHECK(early.faces.size() == 1);
  CHECK(early.points.size() == 3);
  const formats::RawMesh none = read_raw(
      ".ply", vertex_header("1") + "element face 1\nproperty uchar red\nend_header\n1 2 3\n255\n");
  CHECK(none.faces.empty());
  const formats::RawMesh line =
      read_raw(".ply", vertex_header("2") + kFaces + "end_header\n1 2 3\n4 5 6\n2 0 1\n");
  CHECK(line.faces.empty());
}

TEST_CASE("PLY: what is not one says so", "[load][ply]") {
  CHECK_THAT(ply_error("Dear Sir or Madam,\nplease find"),
             has("not a PLY file: starts with 'Dear"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nelement vertex 3"), has("no end_header"));
  CHECK_THAT(ply_error("ply\nend_header\n"), has("line 2: the header ends without a format"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nend_header\n"), has("no element vertex"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                       "property float y\nend_header\n1 2\n"),
             has("no property z"));
  CHECK_THAT(ply_error("ply\nformat utf8 1.0\n"), has("line 2: expected format ascii"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"),
             has("line 4: expected a type such as float or uchar, found 'real'"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nelement vertex -1\n"), has("found '-1'"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nproperty float x\n"), has("before the first"));
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nelement v\xff 1\n"), has("name 'v\\xff'"));
  CHECK(ply_error("ply\nformat ascii 1.0\nelement " + std::string(100000, 'v') + " 1\n").size() <
        100);
  CHECK_THAT(ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                       "property float x\n"),
             has("line 5: a second property 'x'"));
}

TEST_CASE("PLY: a count the file cannot hold is refused before it is believed", "[load][ply]") {
  CHECK_THAT(ply_error(vertex_header("4000000000") + "end_header\n1 2 3\n4 5 6\n"),
             has("claims 4000000000 vertices, the file has room for at most 2"));
  CHECK(read_raw(".ply", vertex_header("1") + "end_header\n1 2 3").points.size() ==
        1);  // just room
  const std::string three(36, '\0');
  CHECK_THAT(ply_error(vertex_header("4", "binary_little_endian") + "end_header\n" + three),
             has("claims 4 vertices, the file has room for at most 3"));
  CHECK_THAT(ply_error(vertex_header("3", "binary_little_endian") +
                       "element face 4294967295\nproperty list uchar int vertex_indices\n"
                       "end_header\n" +
                       three),
             has("claims 4294967295 faces, the file has room for at most 0"));
  std::string list = vertex_header("3", "binary_little_endian") +
                     "element face 1\nproperty list uint int vertex_indices\nend_header\n" + three;
  append<std::uint32_t>(list, 4000000000U);
  CHECK_THAT(ply_error(list), has("within face 1 of 1"));
}

TEST_CASE("PLY: damage in ascii data names its line", "[load][ply]") {
  const std::string header = vertex_header("3") + kFaces + "end_header\n";  // 9 lines
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n"),
             has("line 12: expected a number, found 'one'"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), has("line 11: ends where"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0 9\n0 1 0\n3 0 1 2\n"),
             has("line 11: more on the line than the header says, from '9' (vertex 2 of 3)"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
             has("line 13: a face refers to vertex 3, expected 0 to 3 exclusive (face 1 of 1)"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), has("vertex -1"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), has("vertex 1.5"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), has("line 13"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 1 0      \n"),
             has("the file ends after line 12, expected face 1 of 1"));
  CHECK_THAT(ply_error(header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n"),
             has("line 14: more in the file"));
}

TEST_CASE("PLY: a header of endless names ends", "[load][ply]") {
  std::string bytes = vertex_header("1");
  for (int i = 0; i < 200000; ++i) bytes += "property float p" + std::to_string(i) + "\n";
  CHECK_THAT(ply_error(bytes), has("too many properties"));
}

TEST_CASE("PLY: the laser scan rs1", "[load][ply]") {
  const char* given = std::getenv("POSEVOTE_DATA");
  const std::filesystem::path data = given ? given : POSEVOTE_SOURCE_DIR "/../shared/data";
  const std::filesystem::path scene = data / "uwa/scenes/rs1.ply";
  if (!std::filesystem::exists(scene)) {
    WARN("skipped: no " << scene);
    return;
  }
  const Scan scan = formats::read_scan(scene, 0.001);
  CHECK(is_valid(scan));
  CHECK(scan.points.rows() == 114373);
  CHECK(scan.normals.rows() == 114373);
  CHECK(scan.faces.rows() == 221803);
  CHECK(scan.points(0, 2) == Approx(-0.58831));
  // The sensor stands at the origin, and normals point to it.
  CHECK((scan.points.cwiseProduct(scan.normals).rowwise().sum().array() > 0).count() == 0);
}

}  // namespace posevote::read_ply_test
