// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/write_ply.hpp"

#include <catch2/catch.hpp>

#include "nodes/formats/read_scan.hpp"
#include "tests/nodes/write/writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::write_ply_test {

using namespace posevote::formats;
using posevote::test::read_text;
using posevote::test::TemporaryFolder;

namespace {

Mesh triangle() {
  Mesh mesh;
  mesh.points.resize(3, 3);
  mesh.points << 0.1F, 0.2F, 0.3F, 1, 0, 0, 0, -1, 0;
  mesh.normals.resize(3, 3);
  mesh.normals << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  mesh.faces.resize(1, 3);
  mesh.faces << 0, 2, 1;
  return mesh;
}

bool is_empty(const TemporaryFolder& folder) { return std::filesystem::is_empty(folder.path()); }

}  // namespace

TEST_CASE("a written PLY is read back: points, normals, faces", "[write]") {
  const TemporaryFolder folder;
  const Mesh mesh = triangle();
  formats::write_ply(folder / "a.ply", mesh, 1000);
  const Mesh read = formats::read_mesh(folder / "a.ply", 0.001);
  CHECK(read.points.isApprox(mesh.points, 1e-6F));
  CHECK(read.normals == mesh.normals);
  CHECK(read.faces == mesh.faces);
  CHECK(read_text(folder / "a.ply").find("\nproperty uchar red\n") == std::string::npos);

  Mesh bare;
  bare.points = mesh.points;
  formats::write_ply(folder / "a.ply", bare);  // over the first
  const Mesh second = formats::read_mesh(folder / "a.ply", 1);
  CHECK(second.points == mesh.points);
  CHECK(second.normals.rows() == 0);
  CHECK(second.faces.rows() == 0);
}

TEST_CASE("the bytes of a vertex are position, normal, colour", "[write]") {
  const TemporaryFolder folder;
  Mesh mesh = triangle();
  mesh.faces.resize(0, 3);
  formats::write_ply(folder / "a.ply", mesh, 1, {{1, 2, 3}, {4, 5, 6}, {7, 8, 250}});
  const std::string text = read_text(folder / "a.ply");
  const std::size_t body = text.find("end_header\n") + 11;
  REQUIRE(text.size() == body + 3 * (6 * 4 + 3));
  CHECK(text.substr(body + 24, 3) == "\x01\x02\x03");
  CHECK(text.substr(text.size() - 3) == "\x07\x08\xfa");
}

TEST_CASE("counts that contradict each other are not written", "[write]") {
  const TemporaryFolder folder;
  Mesh mesh = triangle();
  CHECK_THROWS_AS(formats::write_ply(folder / "a.ply", mesh, 1, {{1, 2, 3}}),
                  std::invalid_argument);
  mesh.faces(0, 1) = 3;
  CHECK_THROWS_AS(formats::write_ply(folder / "a.ply", mesh), std::invalid_argument);
  mesh = triangle();
  mesh.normals.conservativeResize(2, 3);
  CHECK_THROWS_AS(formats::write_ply(folder / "a.ply", mesh), std::invalid_argument);
  CHECK(is_empty(folder));
}

TEST_CASE("a full disk leaves no half PLY and keeps the old one", "[write]") {
  const TemporaryFolder folder;
  Mesh big;
  big.points = test::make_patch(100, 0.01F, 1).points;
  {
    const test::FullDisk full(5000);
    CHECK_THROWS_WITH(formats::write_ply(folder / "a.ply", big),
                      Catch::Contains("a.ply: cannot be written"));
    CHECK(is_empty(folder));
  }
  formats::write_ply(folder / "a.ply", triangle());
  const std::string before = read_text(folder / "a.ply");
  const test::FullDisk full(5000);
  CHECK_THROWS_AS(formats::write_ply(folder / "a.ply", big), std::runtime_error);
  CHECK(read_text(folder / "a.ply") == before);
}

TEST_CASE("a place that cannot be written to is named", "[write]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(formats::write_ply(folder / "none/a.ply", triangle()),
                    Catch::Contains("none/a.ply: cannot be written: No such file"));
  std::filesystem::create_directories(folder / "b.ply");
  CHECK_THROWS_WITH(formats::write_ply(folder / "b.ply", triangle()),
                    Catch::Contains("b.ply: cannot be"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.ply.part"));
}

}  // namespace posevote::write_ply_test
