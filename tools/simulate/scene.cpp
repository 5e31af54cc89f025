// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/scene.hpp"

namespace posevote {
namespace {

void append_box(Mesh& mesh, const Eigen::RowVector3f& low, const Eigen::RowVector3f& high) {
  const auto first = static_cast<std::uint32_t>(mesh.points.rows());
  mesh.points.conservativeResize(first + 8, 3);
  for (unsigned corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      mesh.points(first + corner, axis) = (corner >> axis & 1U) != 0 ? high[axis] : low[axis];
  constexpr std::uint32_t kSides[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                                           {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                           {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  const Eigen::Index face = mesh.faces.rows();
  mesh.faces.conservativeResize(face + 12, 3);
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 3; ++k) mesh.faces(face + i, k) = first + kSides[i][k];
}

}  // namespace

Body make_table(double side) {
  Mesh mesh;
  const auto half = static_cast<float>(side / 2);
  mesh.points.resize(4, 3);
  mesh.points << -half, -half, 0, half, -half, 0, half, half, 0, -half, half, 0;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  return {std::make_shared<Mesh>(std::move(mesh)), 0, Eigen::Isometry3d::Identity()};
}

Body make_bin(double radius) {
  constexpr float kWall = 0.006F, kHeight = 0.1F;
  const auto in = static_cast<float>(radius);
  const float out = in + kWall;
  Mesh mesh;
  append_box(mesh, {-out, -out, -kWall}, {out, out, 0});
  append_box(mesh, {-out, -out, 0}, {-in, out, kHeight});
  append_box(mesh, {in, -out, 0}, {out, out, kHeight});
  append_box(mesh, {-in, -out, 0}, {in, -in, kHeight});
  append_box(mesh, {-in, in, 0}, {in, out, kHeight});
  return {std::make_shared<Mesh>(std::move(mesh)), 0, Eigen::Isometry3d::Identity()};
}

}  // namespace posevote
