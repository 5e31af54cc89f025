// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Says whether a point of a mesh can be seen from afar (Embree 3). Threads may share it.
class Occluder {
 public:
  /// `faces` must refer to `points`. Throws std::runtime_error where there are none, or if Embree
  /// fails.
  Occluder(const PointMatrix& points, const FaceMatrix& faces);
  ~Occluder();
  Occluder(const Occluder&) = delete;
  Occluder& operator=(const Occluder&) = delete;

  /// Whether a ray from `point` [m] in a direction of unit length meets no face. Faces within a
  /// hundred thousandth of the mesh's diagonal do not count: the point may lie on them.
  bool escapes(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace posevote::geometry
