// SPDX-License-Identifier: BSD-3-Clause
// A tile of a depth image, whose normals may be mixed of those at its corners if all of them are on
// one smooth piece of ground.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>

namespace posevote::prepare {

/// The ground between four points with normals: upper left and right, lower left and right.
class Tile {
 public:
  struct Patch {
    Eigen::Vector3f point = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< toward the sensor; 0: none
  };

  /// `radius`: of the planes that the normals are of [m].
  Tile(const std::array<Patch, 4>& corners, float radius) : corners_(corners), radius_(radius) {}

  /// Whether the corners are near each other, their normals alike, and they on each other's planes.
  bool is_smooth() const {
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        if (!(corners_[a].normal.dot(corners_[b].normal) >= kSameNormal &&
              (corners_[a].point - corners_[b].point).norm() <= kFarthest * radius_ &&
              is_flush(corners_[a].point, corners_[b])))
          return false;
    return true;
  }

  /// Where x and y go from 0 to 1.
  Patch at(float x, float y) const {
    const std::array<float, 4> weights{(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    Patch mean;
    for (std::size_t i = 0; i < 4; ++i) {
      mean.point += weights[i] * corners_[i].point;
      mean.normal += weights[i] * corners_[i].normal;
    }
    mean.normal.normalize();
    return mean;
  }

  /// Whether a point is about on the plane of a patch.
  bool is_flush(const Eigen::Vector3f& point, const Patch& with) const {
    return std::abs((point - with.point).dot(with.normal)) <= kFlush * radius_;
  }

 private:
  static constexpr float kSameNormal = 0.98F;  // cosine, 11 deg
  static constexpr float kFlush = 0.45F;       // of the radius, off a plane
  static constexpr float kFarthest = 4;        // of the radius, between corners

  std::array<Patch, 4> corners_;
  float radius_;
};

}  // namespace posevote::prepare
