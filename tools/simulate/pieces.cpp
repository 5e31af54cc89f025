// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tools/simulate/split_faces.hpp"

namespace posevote {
namespace {

using Eigen::Vector3d;

constexpr int kPieces = 6;       // along the longest side
constexpr int kColumns = 4;      // of inside points, along a piece' side
constexpr double kCoarse = 0.6;  // of a piece' side: triangles with longer edges are cut up

/// Points by the cube that they are in.
class Sorter {
 public:
  explicit Sorter(const Mesh& mesh)
      : low_(mesh.points.colwise().minCoeff()), cube_(longest_side(mesh) / double{kPieces}) {}

  double cube() const { return cube_; }
  Vector3d low() const { return low_.transpose().cast<double>(); }
  std::set<std::uint32_t>& piece_at(const Vector3d& place) {
    const Vector3d from_low = place - low();
    std::array<int, 3> key{};
    for (int axis = 0; axis < 3; ++axis)
      key[static_cast<std::size_t>(axis)] = static_cast<int>(from_low[axis] / cube_);
    return pieces_[key];
  }
  std::vector<std::set<std::uint32_t>> take() {
    std::vector<std::set<std::uint32_t>> list;
    list.reserve(pieces_.size());
    for (auto& [key, corners] : pieces_) list.push_back(std::move(corners));
    return list;
  }

 private:
  Eigen::RowVector3f low_;
  double cube_;
  std::map<std::array<int, 3>, std::set<std::uint32_t>> pieces_;
};

bool is_coarse(const Mesh& mesh, double cube) {
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    const Eigen::Matrix3d m = corners_of(mesh, face);
    for (int k = 0; k < 3; ++k)
      if ((m.col(k) - m.col((k + 1) % 3)).norm() > kCoarse * cube) return true;
  }
  return false;
}

/// Heights at which the vertical line through (x, y) meets the surface, in ascending order.
std::vector<double> crossings(const Mesh& mesh, double x, double y) {
  std::vector<double> heights;
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    const Eigen::Matrix3d m = corners_of(mesh, face);
    double weights[3], sum = 0;
    bool left = true, right = true;
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = m.col((k + 1) % 3), b = m.col((k + 2) % 3);
      weights[k] = (a.x() - x) * (b.y() - y) - (b.x() - x) * (a.y() - y);
      left &= weights[k] > 0, right &= weights[k] < 0;
      sum += weights[k];
    }
    if (!left && !right) continue;
    heights.push_back((weights[0] * m(2, 0) + weights[1] * m(2, 1) + weights[2] * m(2, 2)) / sum);
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// Calls visit(point) for a grid of points inside of the body.
template <class Visit>
void for_each_inside(const Mesh& mesh, const Sorter& sorter, const Visit& visit) {
  const double pitch = sorter.cube() / kColumns;
  const Vector3d low = sorter.low();
  constexpr int kCount = kPieces * kColumns;
  for (int i = 0; i < kCount; ++i)
    for (int k = 0; k < kCount; ++k) {
      // Off the middle by odd parts, so that lines miss the edges of symmetric bodies.
      const double x = low.x() + (i + 0.4871) * pitch, y = low.y() + (k + 0.5237) * pitch;
      const std::vector<double> heights = crossings(mesh, x, y);
      for (std::size_t h = 0; h + 1 < heights.size(); h += 2)
        for (int step = 0; step < kCount; ++step)
          if (const double z = low.z() + (step + 0.5) * pitch; z > heights[h] && z < heights[h + 1])
            visit(Vector3d(x, y, z));
    }
}

Pieces cut_up_coarse(const Mesh& mesh, Sorter& sorter) {
  // A face at the very end of the box belongs to the last piece before it.
  const Vector3d last = sorter.low() + Vector3d::Constant((kPieces - 0.5) * sorter.cube());
  std::vector<Vector3d> points;
  const auto add = [&](const Vector3d& point, const Vector3d& place) {
    sorter.piece_at(place.cwiseMin(last)).insert(static_cast<std::uint32_t>(points.size()));
    points.push_back(point);
  };
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face)
    for_each_part(corners_of(mesh, face), kCoarse * sorter.cube(), [&](const Eigen::Matrix3d& m) {
      for (int k = 0; k < 3; ++k) add(m.col(k), m.rowwise().mean());
    });
  for_each_inside(mesh, sorter, [&](const Vector3d& point) { add(point, point); });
  Pieces pieces;
  pieces.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    pieces.points.row(static_cast<Eigen::Index>(i)) = points[i].transpose().cast<float>();
  pieces.list = sorter.take();
  return pieces;
}

}  // namespace

Pieces cut_up(const Mesh& mesh) {
  Sorter sorter(mesh);
  if (is_coarse(mesh, sorter.cube())) return cut_up_coarse(mesh, sorter);
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    std::set<std::uint32_t>& piece = sorter.piece_at(corners_of(mesh, face).rowwise().mean());
    for (int k = 0; k < 3; ++k) piece.insert(mesh.faces(face, k));
  }
  return {mesh.points, sorter.take()};
}

}  // namespace posevote
