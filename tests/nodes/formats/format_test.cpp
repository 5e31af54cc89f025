// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/format.hpp"

#include "nodes/formats/read_scan.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::format_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

/// One point a file: all that a format has to do.
formats::RawMesh read_one_point(std::string_view) {
  formats::RawMesh mesh;
  mesh.points = {{1, 2, 3}};
  return mesh;
}

const auto registered =
    formats::register_format("test points", {".posevote-a", ".posevote-b"}, read_one_point);

}  // namespace

TEST_CASE("a registered format is found, listed and read by each of its endings", "[formats]") {
  const TempDir dir;
  for (const char* name : {"x.posevote-a", "y.Posevote-B"}) {
    INFO(name);
    REQUIRE(formats::find_format(name));
    CHECK(formats::find_format(name)->name == "test points");
    CHECK_FALSE(formats::find_format(name)->holds_depth());
    CHECK(formats::has_ending(name, formats::Wanted::kMeshes));
    CHECK_FALSE(formats::has_ending(name, formats::Wanted::kDepthImages));
    CHECK(formats::has_ending(name, formats::Wanted::kAny));
    CHECK(formats::read_scan(dir.write(name, "any"), 1).points.row(0) ==
          Eigen::RowVector3f(1, 2, 3));
  }
  CHECK_THAT(formats::list_endings(formats::Wanted::kMeshes), has(".posevote-a, .posevote-b"));
  CHECK_THAT(formats::list_endings(formats::Wanted::kDepthImages),
             has(".png") && !has(".posevote-a"));
}

TEST_CASE("two formats cannot claim one ending", "[formats]") {
  CHECK_THROWS_WITH(formats::register_format("other points", {".posevote-b"}, read_one_point),
                    "other points and test points both claim '.posevote-b'");
}

TEST_CASE("a depth image is no cloud, and a cloud no depth image", "[formats]") {
  const TempDir dir;
  CHECK(formats::find_format("a.png")->holds_depth());
  CHECK_THAT(error_of([&] { formats::read_scan(dir.write("a.png", depth_png(1, 1, {7})), 1); }),
             has("has the ending '.png', expected .obj, "));
  CHECK_THAT(error_of([&] { formats::read_depth_image(dir.write("a.obj", "v 1 2 3\n")); }),
             has("has the ending '.obj', expected .npy or .png"));
  CHECK(formats::read_depth_image(dir.path("a.png")).values == std::vector<std::uint16_t>{7});
}

}  // namespace posevote::format_test
