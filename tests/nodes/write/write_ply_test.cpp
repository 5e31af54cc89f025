// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/write/write_ply.hpp"

#include <catch2/catch.hpp>

#include "nodes/load/read_cloud.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace posevote;
using posevote::test::read_text;
using posevote::test::TemporaryFolder;

namespace {

Cloud triangle() {
  Cloud cloud;
  cloud.points.resize(3, 3);
  cloud.points << 0, 0, 0, 1, 0, 0, 0, 2, 0.5F;
  return cloud;
}

}  // namespace

TEST_CASE("a PLY holds what was written, scaled", "[write]") {
  const TemporaryFolder folder;
  Cloud cloud = triangle();
  cloud.normals = PointMatrix::Zero(3, 3);
  cloud.normals.col(2).setOnes();
  cloud.faces.resize(1, 3);
  cloud.faces << 0, 1, 2;
  write_ply(folder / "a.ply", cloud, 1000, {{255, 0, 0}, {0, 255, 0}, {1, 2, 3}});
  const Cloud back = read_cloud(folder / "a.ply", 0.001);
  CHECK(back.points.isApprox(cloud.points));
  CHECK(back.normals == cloud.normals);
  CHECK(back.faces == cloud.faces);
  CHECK(read_text(folder / "a.ply").find("property uchar red\n") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "a.ply.part"));
}

TEST_CASE("points alone take 12 bytes each", "[write]") {
  const TemporaryFolder folder;
  write_ply(folder / "a.ply", triangle());
  const std::string text = read_text(folder / "a.ply");
  CHECK(text.size() - text.find("end_header\n") == 11 + 36);
}

TEST_CASE("what cannot be written is named, and leaves nothing behind", "[write]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(write_ply(folder / "none/a.ply", triangle()),
                    Catch::Contains("none/a.ply: cannot be written: "));
  std::filesystem::create_directories(folder / "b.ply/c");
  CHECK_THROWS_AS(write_ply(folder / "b.ply", triangle()), std::runtime_error);
  CHECK_FALSE(std::filesystem::exists(folder / "b.ply.part"));
  Cloud cloud = triangle();
  cloud.faces.resize(1, 3);
  cloud.faces << 0, 1, 3;
  CHECK_THROWS_AS(write_ply(folder / "c.ply", cloud), std::invalid_argument);
  CHECK_THROWS_AS(write_ply(folder / "c.ply", triangle(), 1, {{1, 2, 3}}), std::invalid_argument);
}
