// SPDX-License-Identifier: BSD-3-Clause
// Shapes whose normals are known, and ways to disturb them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote::test {

/// Evenly spread points; their outward normals are points / radius.
inline PointMatrix sphere(int count, float radius) {
  PointMatrix points(count, 3);
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double angle = 2.399963229728653 * i;
    const double ring = std::sqrt(1 - z * z);
    points.row(i) =
        radius *
        Eigen::RowVector3d(ring * std::cos(angle), ring * std::sin(angle), z).cast<float>();
  }
  return points;
}

/// A box of 12 faces around `center`, wound outward (or inward), corners not shared with others.
inline Mesh box(const Eigen::RowVector3f& center, float edge, bool inward = false) {
  Mesh mesh;
  mesh.points.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    mesh.points.row(i) = center + edge * Eigen::RowVector3f(static_cast<float>(i & 1) - 0.5F,
                                                            static_cast<float>((i >> 1) & 1) - 0.5F,
                                                            static_cast<float>(i >> 2) - 0.5F);
  mesh.faces.resize(12, 3);
  mesh.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2,
      4, 6, 1, 3, 5, 3, 7, 5;
  if (inward) mesh.faces.col(1).swap(mesh.faces.col(2));
  return mesh;
}

/// Both meshes as one.
inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh;
  mesh.points.resize(a.points.rows() + b.points.rows(), 3);
  mesh.points << a.points, b.points;
  mesh.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  mesh.faces << a.faces, (b.faces.array() + static_cast<std::uint32_t>(a.points.rows())).matrix();
  return mesh;
}

/// Moves each point by a vector from a ball of radius `most` [m].
inline PointMatrix shaken(PointMatrix points, float most) {
  std::mt19937 random(7);
  const auto uniform = [&random] { return static_cast<float>(random()) / 4294967296.0F * 2 - 1; };
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::RowVector3f offset;
    do offset = {uniform(), uniform(), uniform()};
    while (offset.norm() > 1);
    points.row(i) += most * offset;
  }
  return points;
}

/// 0 .. count - 1 in some fixed, disorderly order.
inline std::vector<Eigen::Index> shuffled(Eigen::Index count) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(3);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

inline Eigen::Matrix3f some_rotation() {
  return Eigen::AngleAxisf(1.1F, Eigen::Vector3f(1, -2, 0.5F).normalized()).toRotationMatrix();
}

/// Mean angle between rows [deg].
inline double mean_angle(const PointMatrix& a, const PointMatrix& b) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    sum += std::acos(std::clamp(a.row(i).cast<double>().dot(b.row(i).cast<double>()), -1.0, 1.0));
  return sum / static_cast<double>(a.rows()) * 180 / M_PI;
}

}  // namespace posevote::test
