// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/color/texture_color.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace posevote::texture_color_test {
namespace {

/// Red, green; blue, white.
const ColorImage kFour{2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};

/// A triangle, textured or with colours of its corners.
Mesh triangle() {
  Mesh mesh;
  mesh.points.setRandom(3, 3);
  mesh.faces = FaceMatrix(1, 3);
  mesh.faces << 0, 1, 2;
  return mesh;
}

}  // namespace

TEST_CASE("v counts from the bottom, and images repeat", "[color]") {
  const auto at = [](float u, float v) { return color::texture_color(kFour, {u, v}); };
  CHECK(at(0.25F, 0.75F) == Eigen::RowVector3f(1, 0, 0));
  CHECK(at(0.75F, 0.75F) == Eigen::RowVector3f(0, 1, 0));
  CHECK(at(0.25F, 0.25F) == Eigen::RowVector3f(0, 0, 1));
  CHECK(at(1, 0) == Eigen::RowVector3f(1, 1, 1));
  CHECK(at(1.25F, -0.25F) == at(0.25F, 0.75F));
  CHECK(at(std::nanf(""), 0.75F) == Eigen::RowVector3f(1, 0, 0));
}

TEST_CASE("a face has the colours of its texture, or between those of its corners", "[color]") {
  Mesh mesh = triangle();
  CHECK_FALSE(color::is_colored(mesh));
  CHECK(color::point_colors(mesh).rows() == 0);
  mesh.colors.setIdentity(3, 3);
  CHECK(color::is_colored(mesh));
  CHECK(color::face_color(mesh, mesh.faces.row(0), {0.5F, 0.25F, 0.25F}) ==
        Eigen::RowVector3f(0.5F, 0.25F, 0.25F));
  Texture texture{{kFour}, {}, {0, 0, 0}};
  texture.places.resize(3, 2);
  texture.places << 0, 0, 1, 0, 0, 1;
  mesh.texture = std::make_shared<const Texture>(texture);
  CHECK(color::face_color(mesh, mesh.faces.row(0), {0.1F, 0.8F, 0.1F}) ==
        Eigen::RowVector3f(1, 1, 1));
  CHECK(color::face_color(mesh, mesh.faces.row(0), {0.1F, 0.1F, 0.8F}) ==
        Eigen::RowVector3f(1, 0, 0));
  CHECK(color::point_colors(mesh).row(0) == Eigen::RowVector3f(0, 0, 1));
}

}  // namespace posevote::texture_color_test
