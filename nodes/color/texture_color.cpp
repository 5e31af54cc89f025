// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/color/texture_color.hpp"

#include <algorithm>
#include <cmath>

#include "nodes/color/srgb.hpp"

namespace posevote::color {
namespace {

/// The pixel at a share of an image's side; the image repeats.
std::size_t pixel_at(float share, std::size_t pixels) {
  const double whole = std::isfinite(share) ? static_cast<double>(share) : 0;
  const double place = whole >= 0 && whole <= 1 ? whole : whole - std::floor(whole);
  return std::min(static_cast<std::size_t>(place * static_cast<double>(pixels)), pixels - 1);
}

}  // namespace

Eigen::RowVector3f texture_color(const ColorImage& image, const Eigen::RowVector2f& place) {
  const std::size_t column = pixel_at(place.x(), image.width);
  const std::size_t row = image.height - 1 - pixel_at(place.y(), image.height);
  const std::uint8_t* pixel = image.values.data() + 3 * (row * image.width + column);
  return {linear_of(pixel[0]), linear_of(pixel[1]), linear_of(pixel[2])};
}

bool is_colored(const Mesh& mesh) { return mesh.texture || mesh.colors.rows() > 0; }

Eigen::RowVector3f face_color(const Mesh& mesh, const Eigen::Matrix<std::uint32_t, 1, 3>& corners,
                              const Eigen::RowVector3f& weights) {
  if (!mesh.texture) {
    Eigen::RowVector3f color = Eigen::RowVector3f::Zero();
    for (int k = 0; k < 3; ++k) color += weights[k] * mesh.colors.row(corners[k]);
    return color;
  }
  const Texture& texture = *mesh.texture;
  Eigen::RowVector2f place = Eigen::RowVector2f::Zero();
  for (int k = 0; k < 3; ++k) place += weights[k] * texture.places.row(corners[k]);
  return texture_color(texture.images[texture.image_of[corners[0]]], place);
}

ColorMatrix point_colors(const Mesh& mesh) {
  if (!mesh.texture) return mesh.colors;
  const Texture& texture = *mesh.texture;
  ColorMatrix colors(mesh.points.rows(), 3);
  for (Eigen::Index i = 0; i < colors.rows(); ++i)
    colors.row(i) = texture_color(texture.images[texture.image_of[static_cast<std::size_t>(i)]],
                                  texture.places.row(i));
  return colors;
}

}  // namespace posevote::color
