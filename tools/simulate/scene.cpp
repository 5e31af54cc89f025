// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posevote {
namespace {

constexpr double kCell = 0.0025;  // [m]: about the length of a triangle's side
constexpr int kTries = 8;

/// Heights of what lies on the table, on a grid of cells.
class HeightField {
 public:
  explicit HeightField(double half) : half_(half), side_(static_cast<int>(2 * half / kCell) + 1) {
    heights_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  }

  /// How far up the body has to be moved so that it just touches what lies below it.
  double lift(const Eigen::Matrix3Xd& points, const FaceMatrix& faces) const {
    double most = -std::numeric_limits<double>::infinity();
    for_each_cell(points, faces, [&](std::size_t cell, double low, double) {
      most = std::max(most, heights_[cell] - low);
    });
    return most;
  }
  void add(const Eigen::Matrix3Xd& points, const FaceMatrix& faces) {
    for_each_cell(points, faces, [&](std::size_t cell, double, double high) {
      heights_[cell] = std::max(heights_[cell], high);
    });
  }

 private:
  int cell_of(double x) const {
    return std::clamp(static_cast<int>((x + half_) / kCell), 0, side_ - 1);
  }
  /// visit(cell, lowest z, highest z) for the cells of each triangle's bounding box: too many cells
  /// rather than too few, so that bodies never reach into each other.
  template <class Visit>
  void for_each_cell(const Eigen::Matrix3Xd& points, const FaceMatrix& faces,
                     const Visit& visit) const {
    for (Eigen::Index face = 0; face < faces.rows(); ++face) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = points.col(faces(face, k));
      const Eigen::Vector3d low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
      for (int y = cell_of(low.y()); y <= cell_of(high.y()); ++y)
        for (int x = cell_of(low.x()); x <= cell_of(high.x()); ++x)
          visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                    static_cast<std::size_t>(x),
                low.z(), high.z());
    }
  }

  double half_;
  int side_;
  std::vector<double> heights_;
};

Eigen::Isometry3d random_pose(double radius, Random& random) {
  Eigen::Isometry3d pose(random.rotation());
  do {
    pose.translation() << random.uniform(-radius, radius), random.uniform(-radius, radius), 0;
  } while (pose.translation().norm() > radius);
  return pose;
}

double reach(const std::vector<Body>& bodies) {
  double most = 0;
  for (const Body& body : bodies)
    most = std::max<double>(most, body.mesh->points.rowwise().norm().maxCoeff());
  return most;
}

}  // namespace

Body make_table(double side) {
  Cloud mesh;
  const auto half = static_cast<float>(side / 2);
  mesh.points.resize(4, 3);
  mesh.points << -half, -half, 0, half, -half, 0, half, half, 0, -half, half, 0;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  return {std::make_shared<Cloud>(std::move(mesh)), 0, Eigen::Isometry3d::Identity()};
}

void drop_bodies(std::vector<Body>& bodies, double radius, Random& random) {
  HeightField field(radius + reach(bodies));
  for (Body& body : bodies) {
    const Eigen::Matrix3Xd points = body.mesh->points.transpose().cast<double>();
    double lowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTries; ++i) {
      Eigen::Isometry3d pose = random_pose(radius, random);
      pose.translation().z() = field.lift(pose * points, body.mesh->faces);
      if (pose.translation().z() >= lowest) continue;
      lowest = pose.translation().z();
      body.T_world_body = pose;
    }
    field.add(body.T_world_body * points, body.mesh->faces);
  }
}

}  // namespace posevote
