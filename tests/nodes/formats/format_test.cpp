// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/format.hpp"

#include "nodes/formats/read_cloud.hpp"
#include "tests/nodes/formats/support.hpp"

using namespace posevote;
using namespace posevote::formats;
using namespace posevote::test;

namespace {

/// One point a file: all that a format has to do.
RawMesh read_one_point(std::string_view) {
  RawMesh mesh;
  mesh.points = {{1, 2, 3}};
  return mesh;
}

const auto registered =
    register_format("test points", {".posevote-a", ".posevote-b"}, read_one_point);

}  // namespace

TEST_CASE("a registered format is found, listed and read by each of its endings", "[formats]") {
  const TempDir dir;
  for (const char* name : {"x.posevote-a", "y.Posevote-B"}) {
    INFO(name);
    REQUIRE(find_format(name));
    CHECK(find_format(name)->name == "test points");
    CHECK_FALSE(find_format(name)->holds_depth());
    CHECK(has_ending(name, Wanted::kMeshes));
    CHECK_FALSE(has_ending(name, Wanted::kDepthImages));
    CHECK(has_ending(name, Wanted::kAny));
    CHECK(read_cloud(dir.write(name, "any"), 1).points.row(0) == Eigen::RowVector3f(1, 2, 3));
  }
  CHECK_THAT(list_endings(Wanted::kMeshes), has(".posevote-a, .posevote-b or .stl"));
  CHECK(list_endings(Wanted::kDepthImages) == ".png");
}

TEST_CASE("two formats cannot claim one ending", "[formats]") {
  CHECK_THROWS_WITH(register_format("other points", {".posevote-b"}, read_one_point),
                    "other points and test points both claim '.posevote-b'");
}

TEST_CASE("a depth image is no cloud, and a cloud no depth image", "[formats]") {
  const TempDir dir;
  CHECK(find_format("a.png")->holds_depth());
  CHECK_THAT(error_of([&] { read_cloud(dir.write("a.png", depth_png(1, 1, {7})), 1); }),
             has("has the ending '.png', expected .obj, "));
  CHECK_THAT(error_of([&] { read_depth_image(dir.write("a.obj", "v 1 2 3\n")); }),
             has("has the ending '.obj', expected .png"));
  CHECK(read_depth_image(dir.path("a.png")).values == std::vector<std::uint16_t>{7});
}
