// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/surface_discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nodes/formats/depth_image.hpp"

namespace posevote {
namespace {

constexpr double kNear = 1e-3;  // [m]

/// Depth times this is the range: the length of the ray through a pixel up to depth 1.
double ray_length(const Camera& camera, int u, int v) {
  const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
  return std::sqrt(1 + x * x + y * y);
}

struct Corner {
  double u = 0, v = 0, inverse = 0;  ///< pixel, 1 / depth; inverse = 0: behind the camera
};

std::vector<Corner> project(const PointMatrix& points, const Eigen::Isometry3d& T,
                            const Camera& camera) {
  std::vector<Corner> corners(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d p = T * points.row(i).transpose().cast<double>();
    if (p.z() < kNear) continue;
    corners[static_cast<std::size_t>(i)] = {camera.fx * p.x() / p.z() + camera.cx,
                                            camera.fy * p.y() / p.z() + camera.cy, 1 / p.z()};
  }
  return corners;
}

/// The pixels in [low, high] within [0, size).
std::pair<int, int> pixels(double low, double high, int size) {
  return {static_cast<int>(std::ceil(std::clamp(low, 0.0, double(size)))),
          static_cast<int>(std::floor(std::clamp(high, -1.0, size - 1.0)))};
}

RangeImage window_of(const std::vector<Corner>& corners, int width, int height) {
  double u[2] = {1e9, -1e9}, v[2] = {1e9, -1e9};
  for (const Corner& corner : corners) {
    if (corner.inverse <= 0) continue;
    u[0] = std::min(u[0], corner.u), u[1] = std::max(u[1], corner.u);
    v[0] = std::min(v[0], corner.v), v[1] = std::max(v[1], corner.v);
  }
  const auto [left, right] = pixels(u[0], u[1], width);
  const auto [top, bottom] = pixels(v[0], v[1], height);
  RangeImage image{left, top, std::max(0, right - left + 1), std::max(0, bottom - top + 1), {}};
  image.ranges.assign(
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 0.0F);
  return image;
}

/// Writes 1 / depth wherever the triangle is the nearest so far. 1 / depth is linear in the image.
void draw(const Corner& a, const Corner& b, const Corner& c, RangeImage& image) {
  const double area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  if (a.inverse <= 0 || b.inverse <= 0 || c.inverse <= 0 || area == 0) return;
  const auto [left, right] =
      pixels(std::min({a.u, b.u, c.u}), std::max({a.u, b.u, c.u}), image.x + image.width);
  const auto [top, bottom] =
      pixels(std::min({a.v, b.v, c.v}), std::max({a.v, b.v, c.v}), image.y + image.height);
  for (int v = top; v <= bottom; ++v)
    for (int u = left; u <= right; ++u) {
      const double of_b = ((u - a.u) * (c.v - a.v) - (v - a.v) * (c.u - a.u)) / area;
      const double of_c = ((b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u)) / area;
      const double of_a = 1 - of_b - of_c;
      if (of_a < 0 || of_b < 0 || of_c < 0) continue;
      float& pixel =
          image.ranges[static_cast<std::size_t>((v - image.y) * image.width + u - image.x)];
      pixel = std::max(pixel,
                       static_cast<float>(of_a * a.inverse + of_b * b.inverse + of_c * c.inverse));
    }
}

}  // namespace

RangeImage read_range_image(const layouts::TrueImage& image) {
  try {
    const formats::DepthImage depth = formats::read_depth_image(image.depth);
    RangeImage ranges{0, 0, static_cast<int>(depth.width), static_cast<int>(depth.height), {}};
    const std::vector<float> depths = formats::depths_of(depth, image.camera->depth_scale);
    ranges.ranges.reserve(depths.size());
    for (int v = 0; v < ranges.height; ++v)
      for (int u = 0; u < ranges.width; ++u)
        ranges.ranges.push_back(static_cast<float>(double{depths[ranges.ranges.size()]} *
                                                   ray_length(*image.camera, u, v)));
    return ranges;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(image.depth.string() + ": " + error.what());
  }
}

RangeImage render(const layouts::TrueObject& object, const Eigen::Isometry3d& T_camera_model,
                  const Camera& camera, int width, int height) {
  const std::vector<Corner> corners = project(object.points, T_camera_model, camera);
  RangeImage image = window_of(corners, width, height);
  for (Eigen::Index i = 0; i < object.faces.rows(); ++i)
    draw(corners[object.faces(i, 0)], corners[object.faces(i, 1)], corners[object.faces(i, 2)],
         image);
  std::size_t pixel = 0;
  for (int v = image.y; v < image.y + image.height; ++v)
    for (int u = image.x; u < image.x + image.width; ++u, ++pixel)
      if (image.ranges[pixel] > 0)
        image.ranges[pixel] =
            static_cast<float>(ray_length(camera, u, v) / double{image.ranges[pixel]});
  return image;
}

std::vector<double> surface_discrepancy(const RangeImage& measured, const RangeImage& of_true,
                                        const RangeImage& of_found, double delta, Holes holes,
                                        const std::vector<double>& taus) {
  const auto visible = [&](float range, float seen) {
    if (range <= 0) return false;
    if (seen <= 0) return holes == Holes::visible;
    return double{range} - double{seen} <= delta;
  };
  const int left = std::min(of_true.x, of_found.x), top = std::min(of_true.y, of_found.y);
  const int right = std::max(of_true.x + of_true.width, of_found.x + of_found.width);
  const int bottom = std::max(of_true.y + of_true.height, of_found.y + of_found.height);
  std::size_t in_one = 0, in_both = 0;
  std::vector<std::size_t> apart(taus.size());
  for (int v = top; v < bottom; ++v)
    for (int u = left; u < right; ++u) {
      const float a = of_true.at(u, v), b = of_found.at(u, v), seen = measured.at(u, v);
      const bool true_seen = visible(a, seen);
      const bool found_seen = b > 0 && (true_seen || visible(b, seen));
      in_one += true_seen != found_seen;
      if (!true_seen || !found_seen) continue;
      ++in_both;
      for (std::size_t t = 0; t < taus.size(); ++t)
        apart[t] += std::abs(double{a} - double{b}) >= taus[t];
    }
  std::vector<double> errors(taus.size(), 1.0);
  for (std::size_t t = 0; t < taus.size() && in_one + in_both > 0; ++t)
    errors[t] = static_cast<double>(apart[t] + in_one) / static_cast<double>(in_one + in_both);
  return errors;
}

}  // namespace posevote
