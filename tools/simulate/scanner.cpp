// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/scanner.hpp"

#include <algorithm>
#include <cmath>

#include "graph/parallel.hpp"
#include "tools/simulate/ray_caster.hpp"
#include "tools/simulate/split_faces.hpp"

namespace posevote {
namespace {

constexpr int kNothing = -1;

/// The pixels that a body can cover, those beside the image, too, up to its size beyond each edge.
PixelBox bounds(const std::vector<Eigen::Vector3f>& vertices, const Sensor& sensor) {
  const auto width = static_cast<double>(sensor.width), height = static_cast<double>(sensor.height);
  double left = 2 * width, top = 2 * height, right = -width, bottom = -height;
  for (const Eigen::Vector3f& point : vertices) {
    if (point.z() < 1e-3F) {
      left = -width, right = 2 * width, top = -height, bottom = 2 * height;
      break;
    }
    const double u = sensor.camera.fx * point.x() / point.z() + sensor.camera.cx;
    const double v = sensor.camera.fy * point.y() / point.z() + sensor.camera.cy;
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
  }
  const int x0 = static_cast<int>(std::clamp(std::floor(left), -width, 2 * width));
  const int y0 = static_cast<int>(std::clamp(std::floor(top), -height, 2 * height));
  const int x1 = static_cast<int>(std::clamp(std::ceil(right) + 1, -width, 2 * width));
  const int y1 = static_cast<int>(std::clamp(std::ceil(bottom) + 1, -height, 2 * height));
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

/// A scene as the sensor sees it.
struct Shot {
  const Sensor& sensor;
  TrueDepth truth;
  std::vector<int> owner;  ///< index of the body that each pixel shows
};

Shot shoot(const RayCaster& caster, const Sensor& sensor) {
  const std::size_t pixels = sensor.width * sensor.height;
  Shot shot{sensor,
            {std::vector<double>(pixels), std::vector<double>(pixels)},
            std::vector<int>(pixels, kNothing)};
  graph::parallel_for(sensor.height, 4, [&](std::size_t v) {
    for (std::size_t u = 0; u < sensor.width; ++u) {
      const auto hit = caster.first_hit(ray_of(sensor.camera, double(u), double(v)));
      if (!hit) continue;
      const std::size_t pixel = v * sensor.width + u;
      shot.owner[pixel] = static_cast<int>(hit->body);
      shot.truth.depth[pixel] = hit->distance;  // rays have z = 1
      shot.truth.cosine[pixel] = hit->cosine;
    }
  });
  return shot;
}

/// Counts a body's pixels as if it were alone and the image went on, and those that it is seen in.
BodyView pixels_of(const Body& body, int index, const Eigen::Isometry3d& T_sensor_world,
                   const Shot& shot, const formats::DepthImage& depth) {
  const RayCaster alone({body}, T_sensor_world);
  const PixelBox box = bounds(alone.vertices(0), shot.sensor);
  BodyView view;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      if (!alone.first_hit(ray_of(shot.sensor.camera, x, y))) continue;
      ++view.alone;
      grow(view.box_alone, x, y);
      const auto u = static_cast<std::size_t>(x), v = static_cast<std::size_t>(y);
      if (x < 0 || y < 0 || u >= shot.sensor.width || v >= shot.sensor.height) continue;
      const std::size_t pixel = v * shot.sensor.width + u;
      if (depth.values[pixel] != 0) ++view.valid;
      if (shot.owner[pixel] != index) continue;
      ++view.visible;
      grow(view.box_visible, x, y);
    }
  return view;
}

/// Whether the sensor sees a point of a body: its ray meets the body first, and there.
bool is_seen(const Eigen::Vector3d& point, std::size_t body, const Sensor& sensor,
             const RayCaster& caster) {
  constexpr double kSame = 0.0002;  // [m]
  if (point.z() < 1e-3) return false;
  const Camera& camera = sensor.camera;
  const double u = camera.fx * point.x() / point.z() + camera.cx;
  const double v = camera.fy * point.y() / point.z() + camera.cy;
  if (u < -0.5 || u > static_cast<double>(sensor.width) - 0.5 || v < -0.5 ||
      v > static_cast<double>(sensor.height) - 0.5)
    return false;
  const auto hit = caster.first_hit(point / point.z());
  return hit && hit->body == body && std::abs(hit->distance - point.z()) < kSame;
}

double seen_surface(const Body& body, std::size_t index, const Sensor& sensor,
                    const RayCaster& caster) {
  constexpr double kFine = 0.1;  // of the longest side: as much as a triangle speaks for at most
  const std::vector<Eigen::Vector3f>& vertices = caster.vertices(index);
  const double longest = kFine * longest_side(*body.mesh);
  double all = 0, seen = 0;
  for (Eigen::Index face = 0; face < body.mesh->faces.rows(); ++face) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = vertices[body.mesh->faces(face, k)].cast<double>();
    for_each_part(corners, longest, [&](const Eigen::Matrix3d& part) {
      const double area = (part.col(1) - part.col(0)).cross(part.col(2) - part.col(0)).norm() / 2;
      all += area;
      if (is_seen(part.rowwise().mean(), index, sensor, caster)) seen += area;
    });
  }
  return all > 0 ? seen / all : 0;
}

}  // namespace

std::vector<double> seen_surfaces(const std::vector<Body>& bodies, const Sensor& sensor,
                                  const Eigen::Isometry3d& T_world_sensor) {
  const RayCaster caster(bodies, T_world_sensor.inverse());
  std::vector<double> seen(bodies.size(), 0);
  graph::parallel_for(bodies.size(), 1, [&](std::size_t i) {
    if (bodies[i].obj_id != 0) seen[i] = seen_surface(bodies[i], i, sensor, caster);
  });
  return seen;
}

SimulatedScan scan(const std::vector<Body>& bodies, const Sensor& sensor,
                   const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed) {
  const Eigen::Isometry3d T_sensor_world = T_world_sensor.inverse();
  const RayCaster caster(bodies, T_sensor_world);
  const Shot shot = shoot(caster, sensor);
  SimulatedScan made{take_image(shot.truth, sensor, seed), std::vector<BodyView>(bodies.size())};
  graph::parallel_for(bodies.size(), 1, [&](std::size_t i) {
    made.views[i] = pixels_of(bodies[i], static_cast<int>(i), T_sensor_world, shot, made.depth);
    made.views[i].surface = seen_surface(bodies[i], i, sensor, caster);
  });
  return made;
}

Scan points_of(const formats::DepthImage& depth, const Camera& camera) {
  Scan cloud;
  cloud.points.resize(static_cast<Eigen::Index>(depth.values.size()), 3);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < depth.values.size(); ++i) {
    if (depth.values[i] == 0) continue;
    const double z = depth.values[i] * camera.depth_scale * 0.001;
    cloud.points.row(count++) =
        (z * ray_of(camera, double(i % depth.width), double(i / depth.width))).cast<float>();
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
