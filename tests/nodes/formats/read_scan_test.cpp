// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/read_scan.hpp"

#include "tests/nodes/formats/support.hpp"

namespace posevote::read_scan_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n1 2 3\n";

std::string read_error(const std::filesystem::path& path) {
  return error_of([&] { formats::read_scan(path, 1); });
}

}  // namespace

TEST_CASE("The extension chooses the reader", "[load]") {
  const TempDir dir;
  const std::string pcd = "VERSION 0.7\nFIELDS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n";
  for (const auto& path :
       {dir.write("a.ply", kPly), dir.write("a.PLY", kPly), dir.write("a.pcd", pcd),
        dir.write("a.obj", "v 1 2 3\n"), dir.write("a.off", "OFF\n1 0 0\n1 2 3\n"),
        dir.write("a.stl",
                  "solid\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 1 2 3\n"
                  "vertex 1 2 3\nendloop\nendfacet\nendsolid\n")}) {
    INFO(path);
    const Scan scan = formats::read_scan(path, 0.001);
    REQUIRE(scan.points.rows() == 1);
    CHECK(scan.points.row(0).isApprox(Eigen::RowVector3f(0.001F, 0.002F, 0.003F)));
  }
  CHECK_THAT(read_error(dir.write("a.xyz", "1 2 3\n")),
             has("has the ending '.xyz', expected .obj, .off, "));
  CHECK_THAT(read_error(dir.write("ply", kPly)), has("has the ending ''"));
  CHECK_THAT(read_error(dir.write("b.ply", "OFF\n1 0 0\n")), has("not a PLY file"));
}

TEST_CASE("Files that cannot be read say why", "[load]") {
  const TempDir dir;
  CHECK(read_error(dir.path("none.ply")) == "there is no such file");
  CHECK_THAT(read_error(dir.write("empty.ply", "")), has("empty (0 bytes)"));
  std::filesystem::create_directory(dir.path("folder.ply"));
  CHECK_THAT(read_error(dir.path("folder.ply")), has("is a directory"));
  std::filesystem::create_symlink("nowhere.ply", dir.path("link.ply"));
  CHECK_THAT(read_error(dir.path("link.ply")), has("dangling link: its target nowhere.ply"));
  CHECK_THAT(read_error("/dev/null"), has("not a regular file"));
  CHECK(read_error(dir.write("a.ply", kPly) / "b.ply") != "(no error)");
  const auto locked = dir.write("locked.ply", kPly);
  std::filesystem::permissions(locked, std::filesystem::perms::none);
  if (::geteuid() != 0) CHECK_THAT(read_error(locked), has("cannot be opened: Permission denied"));
  std::filesystem::resize_file(dir.write("sparse.ply", "x"), std::uintmax_t{1} << 36);
  CHECK_THAT(read_error(dir.path("sparse.ply")), has("68719476736 bytes, expected at most"));
}

}  // namespace posevote::read_scan_test
