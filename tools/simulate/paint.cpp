// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/paint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/color/srgb.hpp"
#include "tools/simulate/random.hpp"

namespace posevote {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

bool is_printed(const std::string& shape) {
  constexpr std::array kPrinted{"carton", "can", "bottle", "tin", "juice", "shampoo", "milk"};
  return std::find(kPrinted.begin(), kPrinted.end(), shape) != kPrinted.end();
}

/// Of full hue down to almost grey, dark to light.
Vector3f any_color(Random& random) {
  const double hue = random.uniform(0, 6), depth = random.uniform(0.1, 0.95);
  const double light = random.uniform(0.15, 0.85);
  Vector3f color;
  for (int k = 0; k < 3; ++k) {
    const double away = std::abs(std::remainder(hue - 2 * k, 6.0));  // 0 at the hue, 3 opposite
    const double share = std::clamp(2 - away, 0.0, 1.0);
    color[k] = static_cast<float>(light * (1 - depth + depth * share));
  }
  return color;
}

std::vector<Vector3f> any_palette(Random& random, std::size_t count) {
  std::vector<Vector3f> palette;
  for (std::size_t i = 0; i < count; ++i) palette.push_back(any_color(random));
  return palette;
}

}  // namespace

Paint::Paint(const Mesh& mesh, const std::string& shape, std::uint64_t seed) {
  low_ = mesh.points.colwise().minCoeff().transpose().cast<double>();
  size_ = mesh.points.colwise().maxCoeff().transpose().cast<double>() - low_;
  size_ = size_.cwiseMax(1e-6);
  Random random(seed, 0xC0105U);
  const bool printed = is_printed(shape);
  const std::vector<Vector3f> palette = any_palette(random, printed ? 4 : 2);
  const int fields = printed ? 14 : 3;
  for (int i = 0; i < fields; ++i) add_field(random, palette, printed);
}

Paint Paint::ground(std::uint64_t seed) {
  Random random(seed, 0x6200DU);
  Paint paint;
  paint.add_field(random, {0.5F * any_color(random) + Vector3f::Constant(0.15F)}, false);
  return paint;
}

void Paint::add_field(Random& random, const std::vector<Vector3f>& palette, bool printed) {
  Field field;
  for (int axis = 0; axis < 3; ++axis) field.middle[axis] = random.uniform();
  field.color = palette[random.next() % palette.size()];
  field.print = palette[random.next() % palette.size()];
  const Vector3d across = random.direction();
  const bool has_print = printed && random.uniform() < 0.6;
  field.across = has_print ? Vector3d(across / random.uniform(0.008, 0.025)) : Vector3d::Zero();
  fields_.push_back(field);
}

Vector3f Paint::at(const Vector3d& place) const {
  const Vector3d unit = (place - low_).cwiseQuotient(size_);
  const Field& field =
      *std::min_element(fields_.begin(), fields_.end(), [&](const Field& a, const Field& b) {
        return (a.middle - unit).squaredNorm() < (b.middle - unit).squaredNorm();
      });
  if (field.across.isZero()) return field.color;
  const double line = field.across.dot(place);
  return line - std::floor(line) < 0.4 ? field.print : field.color;
}

PaintedFaces paint_faces(const Mesh& mesh, const Paint& paint) {
  constexpr std::size_t kMostAside = 2048;
  const auto faces = static_cast<std::size_t>(mesh.faces.rows());
  const auto aside = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(faces))));
  const std::size_t tile = std::clamp<std::size_t>(kMostAside / aside, 8, 192);
  PaintedFaces painted;
  painted.image = {aside * tile, aside * tile,
                   std::vector<std::uint8_t>(3 * aside * tile * aside * tile)};
  painted.places.resize(mesh.faces.rows(), 6);
  const double side = static_cast<double>(painted.image.width);
  const double reach = static_cast<double>(tile) - 3;  // from pixel 1.5 on: neighbours are tiles
  for (std::size_t f = 0; f < faces; ++f) {
    const auto face = static_cast<Eigen::Index>(f);
    const std::size_t column = f % aside * tile, row = f / aside * tile;
    const auto corner = [&](int k) -> Vector3d {
      return mesh.points.row(mesh.faces(face, k)).transpose().cast<double>();
    };
    const Vector3d a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    for (std::size_t y = 0; y < tile; ++y)
      for (std::size_t x = 0; x < tile; ++x) {
        const double s = (static_cast<double>(x) - 1) / reach,
                     t = (static_cast<double>(y) - 1) / reach;
        const Vector3f color = paint.at(a + s * ab + t * ac);
        std::uint8_t* pixel =
            painted.image.values.data() + 3 * ((row + y) * painted.image.width + column + x);
        for (int k = 0; k < 3; ++k) pixel[k] = color::byte_of(color[k]);
      }
    constexpr int kCorners[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (int k = 0; k < 3; ++k) {
      const double x = static_cast<double>(column) + 1.5 + kCorners[k][0] * reach;
      const double y = static_cast<double>(row) + 1.5 + kCorners[k][1] * reach;
      painted.places(face, 2 * k) = static_cast<float>(x / side);
      painted.places(face, 2 * k + 1) = static_cast<float>(1 - y / side);
    }
  }
  return painted;
}

std::vector<std::array<std::uint8_t, 3>> paint_points(const Mesh& mesh, const Paint& paint) {
  std::vector<std::array<std::uint8_t, 3>> colors;
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    const Vector3f color = paint.at(mesh.points.row(i).transpose().cast<double>());
    colors.push_back(
        {color::byte_of(color[0]), color::byte_of(color[1]), color::byte_of(color[2])});
  }
  return colors;
}

}  // namespace posevote
