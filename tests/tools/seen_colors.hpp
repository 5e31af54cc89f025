// SPDX-License-Identifier: BSD-3-Clause
// Whether an image shows a mesh's colours where a pose puts them.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "nodes/color/srgb.hpp"
#include "nodes/color/texture_color.hpp"
#include "nodes/data/cloud.hpp"
#include "nodes/formats/color_image.hpp"

namespace posevote::test {

/// Correlation of a mesh's green with that of an image, over what faces the camera.
inline double likeness_of(const Mesh& model, const Eigen::Isometry3d& T_scene_model,
                          const Camera& camera, const ColorImage& image, double du, double dv) {
  std::map<std::array<long, 3>, std::vector<Eigen::RowVector2d>> sides;
  for (Eigen::Index face = 0; face < model.faces.rows(); ++face) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = model.points.row(model.faces(face, k)).transpose().cast<double>();
    const Eigen::Vector3d normal =
        (T_scene_model.linear() *
         (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)))
            .normalized();
    const Eigen::Vector3d way = 4 * normal;
    auto& side = sides[{std::lround(way.x()), std::lround(way.y()), std::lround(way.z())}];
    for (int i = 1; i < 64; ++i) {
      const Eigen::RowVector3f weights(static_cast<float>(i % 8) / 16,
                                       static_cast<float>(i / 8) / 16,
                                       1 - static_cast<float>(i % 8 + i / 8) / 16);
      const Eigen::Vector3d place =
          T_scene_model * Eigen::Vector3d(corners * weights.transpose().cast<double>());
      if (normal.dot(-place.normalized()) < 0.3) continue;
      const double u = camera.fx * place.x() / place.z() + camera.cx + du;
      const double v = camera.fy * place.y() / place.z() + camera.cy + dv;
      const std::size_t pixel = static_cast<std::size_t>(std::lround(v)) * image.width +
                                static_cast<std::size_t>(std::lround(u));
      side.emplace_back(color::face_color(model, model.faces.row(face), weights)[1],
                        color::linear_of(image.values.at(3 * pixel + 1)));
    }
  }
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& [way, colors] : sides) {
    Eigen::RowVector2d mean = Eigen::RowVector2d::Zero();
    for (const auto& pair : colors) mean += pair / static_cast<double>(colors.size());
    for (const auto& pair : colors) spread += (pair - mean).transpose() * (pair - mean);
  }
  return spread(0, 1) / std::sqrt(spread(0, 0) * spread(1, 1));
}

}  // namespace posevote::test
