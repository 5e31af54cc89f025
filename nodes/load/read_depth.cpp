// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/load/read_depth.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "nodes/color/srgb.hpp"
#include "nodes/formats/color_image.hpp"
#include "nodes/formats/depth_image.hpp"

namespace posevote::load {
namespace {

constexpr double kFarthest = 1e6;  // [m]; NaN and infinity are no measurement

void check_camera(const Camera& camera) {
  constexpr double kMostScale = 1e6;
  constexpr double kMostPixels = 1e6;  // beyond, points need not be finite any more
  const auto focal = [](double f) { return f >= 1 && f <= kMostPixels; };
  // A principal point of exactly (0, 0) was not given: it lies near the image's centre.
  const bool centred = std::abs(camera.cx) <= kMostPixels && std::abs(camera.cy) <= kMostPixels &&
                       (camera.cx != 0 || camera.cy != 0);
  if (!focal(camera.fx) || !focal(camera.fy) || !centred)
    throw std::runtime_error(
        "a depth image needs its camera: fx = " + std::to_string(camera.fx) +
        ", fy = " + std::to_string(camera.fy) + ", cx = " + std::to_string(camera.cx) +
        ", cy = " + std::to_string(camera.cy) +
        " pixels. Put a camera.json beside the images ({\"fx\": 572.4, \"fy\": ..., \"cx\": ..., "
        "\"cy\": ..., \"depth_scale\": mm per unit}), set load_scene.fx, fy, cx and cy (as in "
        "--set load_scene.fx=572.4), or use a data set with scene_camera.json");
  if (!(camera.depth_scale > 0 && camera.depth_scale <= kMostScale))
    throw std::runtime_error("depth_scale is " + std::to_string(camera.depth_scale) +
                             " mm per unit, expected more than 0 and at most 1e6");
}

Eigen::AlignedBox2f pixel_bounds(const Camera& camera, const LoadedDepth& image) {
  const auto width = static_cast<double>(image.width), height = static_cast<double>(image.height);
  const Eigen::Vector2d low((-0.5 - camera.cx) / camera.fx, (-0.5 - camera.cy) / camera.fy);
  const Eigen::Vector2d high((width - 0.5 - camera.cx) / camera.fx,
                             (height - 0.5 - camera.cy) / camera.fy);
  return {low.cast<float>(), high.cast<float>()};
}

}  // namespace

Scan points_of(const LoadedDepth& image, const ColorImage* color, const Camera& camera,
               const DepthRange& range) {
  check_camera(camera);
  Scan scan;
  scan.points.resize(static_cast<Eigen::Index>(image.depths.size()), 3);
  if (color) scan.colors.resize(scan.points.rows(), 3);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < image.depths.size(); ++i) {
    const float z = image.depths[i];
    const double depth = z;
    if (!(depth > 0 && depth >= range.near && depth <= (range.far > 0 ? range.far : kFarthest)))
      continue;
    const std::size_t row = i / image.width, column = i % image.width;
    const auto u = static_cast<double>(column), v = static_cast<double>(row);
    if (color)
      for (std::size_t k = 0; k < 3; ++k)
        scan.colors(count, static_cast<Eigen::Index>(k)) =
            color::linear_of(color->values[3 * i + k]);
    scan.points.row(count++) << static_cast<float>((u - camera.cx) * depth / camera.fx),
        static_cast<float>((v - camera.cy) * depth / camera.fy), z;
  }
  scan.view.image = pixel_bounds(camera, image);
  scan.view.pixels = {static_cast<int>(image.width), static_cast<int>(image.height)};
  if (count == 0)
    throw std::runtime_error("none of the image's " + std::to_string(image.depths.size()) +
                             " pixels holds a depth within the limits (0 is no measurement)");
  scan.points.conservativeResize(count, 3);
  if (color) scan.colors.conservativeResize(count, 3);
  return scan;
}

LoadedDepth read_depth(const std::filesystem::path& path, const Camera& camera,
                       const DepthRange& range) {
  const formats::DepthImage image = formats::read_depth_image(path);
  if (range.most_pixels > 0 && image.width * image.height > range.most_pixels)
    throw std::runtime_error("has " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels, more than the " +
                             std::to_string(range.most_pixels) +
                             " that memory is granted for (load_scene.max_points, --memory)");
  return {image.width, image.height, formats::depths_of(image, camera.depth_scale)};
}

std::shared_ptr<const ColorImage> read_colors(const std::filesystem::path& path,
                                              const LoadedDepth& depth) {
  auto color = std::make_shared<const ColorImage>(formats::read_color_image(path));
  if (color->width != depth.width || color->height != depth.height)
    throw std::runtime_error("is of " + std::to_string(color->width) + " x " +
                             std::to_string(color->height) + " pixels, the depth image of " +
                             std::to_string(depth.width) + " x " + std::to_string(depth.height));
  return color;
}

}  // namespace posevote::load
