// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "graph/parallel.hpp"
#include "tools/simulate/ray_caster.hpp"

namespace posevote {
namespace {

constexpr int kNothing = -1;

const std::map<std::string, Sensor>& sensors() {
  // The laser's image has fine units, so that rounding adds nothing to its noise. The noise of the
  // RGB-D camera is that of a Kinect (Khoshelham, Elberink 2012).
  static const std::map<std::string, Sensor> known{
      {"laser", {800, 600, {1100, 1100, 399.5, 299.5, 0.05}, 0.0003, 0, 0.17}},
      {"rgbd", {640, 480, {570, 570, 319.5, 239.5, 1.0}, 0, 0.001425, 0.2}}};
  return known;
}

Eigen::Vector3d direction_of(const Camera& camera, std::size_t u, std::size_t v) {
  return {(static_cast<double>(u) - camera.cx) / camera.fx,
          (static_cast<double>(v) - camera.cy) / camera.fy, 1};
}

/// What the sensor reports of a hit; 0: nothing. Directions have z = 1, so distances are depths.
std::uint16_t measure(const RayCaster::Hit& hit, double direction_length, const Sensor& sensor,
                      Random random) {
  if (hit.cosine < sensor.grazing_cosine) return 0;
  const double deviation = sensor.noise + sensor.noise_z2 * hit.distance * hit.distance;
  const double depth = hit.distance + deviation * random.normal() / direction_length;
  const double raw = std::round(depth * 1000 / sensor.camera.depth_scale);
  return raw >= 1 && raw <= 65535 ? static_cast<std::uint16_t>(raw) : std::uint16_t{0};
}

/// The pixels that a body can cover.
PixelBox bounds(const std::vector<Eigen::Vector3f>& vertices, const Sensor& sensor) {
  const double width = static_cast<double>(sensor.width);
  const double height = static_cast<double>(sensor.height);
  double left = width, top = height, right = -1, bottom = -1;
  for (const Eigen::Vector3f& point : vertices) {
    if (point.z() < 1e-3F) return {0, 0, static_cast<int>(width), static_cast<int>(height)};
    const double u = sensor.camera.fx * point.x() / point.z() + sensor.camera.cx;
    const double v = sensor.camera.fy * point.y() / point.z() + sensor.camera.cy;
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
  }
  const int x0 = static_cast<int>(std::clamp(std::floor(left), 0.0, width));
  const int y0 = static_cast<int>(std::clamp(std::floor(top), 0.0, height));
  const int x1 = static_cast<int>(std::clamp(std::ceil(right) + 1, 0.0, width));
  const int y1 = static_cast<int>(std::clamp(std::ceil(bottom) + 1, 0.0, height));
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

void grow(PixelBox& box, int x, int y) {
  if (box.width == 0) {
    box = {x, y, 1, 1};
    return;
  }
  const int right = std::max(box.x + box.width, x + 1),
            bottom = std::max(box.y + box.height, y + 1);
  box.x = std::min(box.x, x), box.y = std::min(box.y, y);
  box.width = right - box.x, box.height = bottom - box.y;
}

/// Counts a body's pixels as if it were alone, and those where `owner` says it is seen.
BodyView view_of(const Body& body, int index, const Sensor& sensor,
                 const Eigen::Isometry3d& T_sensor_world, const std::vector<int>& owner,
                 const DepthImage& depth) {
  const RayCaster alone({body}, T_sensor_world);
  const PixelBox box = bounds(alone.vertices(0), sensor);
  BodyView view;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      const auto u = static_cast<std::size_t>(x), v = static_cast<std::size_t>(y);
      if (!alone.first_hit(direction_of(sensor.camera, u, v))) continue;
      const std::size_t pixel = v * sensor.width + u;
      ++view.alone;
      grow(view.box_alone, x, y);
      if (depth.values[pixel] != 0) ++view.valid;
      if (owner[pixel] != index) continue;
      ++view.visible;
      grow(view.box_visible, x, y);
    }
  return view;
}

}  // namespace

const std::vector<std::string>& sensor_names() {
  static const std::vector<std::string> names{"laser", "rgbd"};
  return names;
}

Sensor find_sensor(const std::string& name) {
  const auto found = sensors().find(name);
  if (found == sensors().end()) throw std::invalid_argument("no sensor is called " + name);
  return found->second;
}

Scan scan(const std::vector<Body>& bodies, const Sensor& sensor,
          const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed) {
  const Eigen::Isometry3d T_sensor_world = T_world_sensor.inverse();
  const RayCaster caster(bodies, T_sensor_world);
  const std::size_t pixels = sensor.width * sensor.height;
  Scan made{{sensor.width, sensor.height, std::vector<std::uint16_t>(pixels)}, {}};
  std::vector<int> owner(pixels, kNothing);
  graph::parallel_for(sensor.height, 4, [&](std::size_t v) {
    for (std::size_t u = 0; u < sensor.width; ++u) {
      const Eigen::Vector3d direction = direction_of(sensor.camera, u, v);
      const auto hit = caster.first_hit(direction);
      if (!hit) continue;
      const std::size_t pixel = v * sensor.width + u;
      owner[pixel] = static_cast<int>(hit->body);
      made.depth.values[pixel] = measure(*hit, direction.norm(), sensor, Random(seed, pixel));
    }
  });
  made.views.resize(bodies.size());
  graph::parallel_for(bodies.size(), 1, [&](std::size_t i) {
    made.views[i] =
        view_of(bodies[i], static_cast<int>(i), sensor, T_sensor_world, owner, made.depth);
  });
  return made;
}

Cloud points_of(const DepthImage& depth, const Camera& camera) {
  Cloud cloud;
  cloud.points.resize(static_cast<Eigen::Index>(depth.values.size()), 3);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < depth.values.size(); ++i) {
    if (depth.values[i] == 0) continue;
    const double z = depth.values[i] * camera.depth_scale * 0.001;
    cloud.points.row(count++) =
        (z * direction_of(camera, i % depth.width, i / depth.width)).cast<float>();
  }
  cloud.points.conservativeResize(count, 3);
  return cloud;
}

Eigen::Isometry3d look_at(const Eigen::Vector3d& target, double distance, double elevation,
                          double azimuth) {
  const Eigen::Vector3d back(std::cos(elevation) * std::cos(azimuth),
                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0);
  Eigen::Isometry3d T_world_sensor;
  T_world_sensor.linear() << right, right.cross(back), -back;
  T_world_sensor.translation() = target + distance * back;
  T_world_sensor.makeAffine();
  return T_world_sensor;
}

}  // namespace posevote
