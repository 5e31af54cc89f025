// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/color_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/color/srgb.hpp"
#include "tools/simulate/ray_caster.hpp"

namespace posevote {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

struct Lamp {
  Vector3d direction;  ///< to it, in the sensor's frame
  Vector3f light;      ///< red, green, blue
};

struct Lighting {
  std::array<Lamp, 2> lamps;
  Vector3f ambient;
  Vector3f gain;          ///< of the camera: exposure and white balance
  Eigen::Vector2d shift;  ///< of the image against the ranges [pixels]
};

Vector3f whitish(Random& random, double strength) {
  const double warmth = random.uniform(-0.12, 0.12);
  return (strength * Vector3d(1 + warmth, 1, 1 - warmth)).cast<float>();
}

/// Lamps are above the ground.
Lighting any_lighting(const Eigen::Isometry3d& T_world_sensor, Random& random) {
  Lighting lighting;
  for (Lamp& lamp : lighting.lamps) {
    Vector3d up = random.direction();
    up.z() = std::abs(up.z()) + 0.3;
    lamp.direction = T_world_sensor.linear().transpose() * up.normalized();
    lamp.light = whitish(random, random.uniform(0.2, 0.6));
  }
  lighting.ambient = whitish(random, random.uniform(0.3, 0.6));
  const double exposure = std::exp2(random.uniform(-1, 1));
  for (int k = 0; k < 3; ++k)
    lighting.gain[k] = static_cast<float>(exposure * random.uniform(0.85, 1.15));
  constexpr double kRegistered = 1;
  lighting.shift = kRegistered * Eigen::Vector2d(random.normal(), random.normal());
  return lighting;
}

/// Lambert's matt surface with a little of Blinn's gloss.
Vector3f seen(const Vector3f& surface, Vector3d normal, const Vector3d& ray,
              const Lighting& lighting) {
  constexpr double kGloss = 0.15, kSharp = 30;
  const Vector3d back = -ray.normalized();
  if (normal.dot(back) < 0) normal = -normal;
  Vector3f light = surface.cwiseProduct(lighting.ambient);
  for (const Lamp& lamp : lighting.lamps) {
    const double facing = std::max(0.0, normal.dot(lamp.direction));
    const double mirror = std::max(0.0, normal.dot((lamp.direction + back).normalized()));
    light += static_cast<float>(facing) * surface.cwiseProduct(lamp.light);
    light += static_cast<float>(kGloss * std::pow(mirror, kSharp)) * lamp.light;
  }
  return light;
}

Vector3f color_of(const Body& body, const Vector3d& place) {
  if (!body.paint) return Vector3f::Constant(0.35F);
  return body.paint->at(body.T_paint_body * place);
}

}  // namespace

ColorImage photograph(const std::vector<Body>& bodies, const Sensor& sensor,
                      const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed) {
  const Eigen::Isometry3d T_sensor_world = T_world_sensor.inverse();
  const RayCaster caster(bodies, T_sensor_world);
  std::vector<Eigen::Isometry3d> T_body_sensor;
  for (const Body& body : bodies)
    T_body_sensor.push_back((T_sensor_world * body.T_world_body).inverse());
  Random random(seed, 0xCA3E2AU);
  const Lighting lighting = any_lighting(T_world_sensor, random);
  const std::uint64_t noise_seed = random.next();
  ColorImage image{sensor.width, sensor.height,
                   std::vector<std::uint8_t>(3 * sensor.width * sensor.height)};
  graph::parallel_for(sensor.height, 4, [&](std::size_t v) {
    for (std::size_t u = 0; u < sensor.width; ++u) {
      Vector3f light = Vector3f::Zero();
      for (const double du : {-0.25, 0.25})
        for (const double dv : {-0.25, 0.25}) {
          const Camera& camera = sensor.camera;
          const Vector3d ray(
              (static_cast<double>(u) + du + lighting.shift.x() - camera.cx) / camera.fx,
              (static_cast<double>(v) + dv + lighting.shift.y() - camera.cy) / camera.fy, 1);
          const auto hit = caster.first_hit(ray);
          if (!hit) continue;
          const Vector3d place = T_body_sensor[hit->body] * (hit->distance * ray);
          light += 0.25F * seen(color_of(bodies[hit->body], place), hit->normal, ray, lighting);
        }
      const std::size_t pixel = v * sensor.width + u;
      Random noise(noise_seed, pixel);
      for (int k = 0; k < 3; ++k) {
        constexpr double kRead = 0.004, kShot = 0.012;
        const double exact = static_cast<double>(lighting.gain[k] * light[k]);
        const double deviation = std::sqrt(kRead * kRead + kShot * kShot * exact);
        image.values[3 * pixel + static_cast<std::size_t>(k)] =
            color::byte_of(static_cast<float>(exact + deviation * noise.normal()));
      }
    }
  });
  return image;
}

}  // namespace posevote
