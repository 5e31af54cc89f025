// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/sensor_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "tools/simulate/spec_reader.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

using graph::in_range;
using graph::make_param;
using graph::ParamSpec;

constexpr double kDegree = std::numbers::pi / 180;

/// As the file has it.
struct SensorSpec {
  int width = 640, height = 480, holes = 0, window = 0;
  double field = 0, fx = 0, fy = 0, cx = 0, cy = 0, depth_scale = 0.05;
  double noise = 0, noise_z2 = 0, grazing_cosine = 0.2, disparity_step = 0, edge_jump = 0;
  double window_noise_z2 = 0, window_shift = 0, edge_shift = 0;
};

const std::vector<ParamSpec>& params() {
  using S = SensorSpec;
  static const std::vector<ParamSpec> all{
      make_param<S>("width", &S::width, "pixel", "", in_range(32, 4096)),
      make_param<S>("height", &S::height, "pixel", "", in_range(32, 4096)),
      make_param<S>("field", &S::field, "deg", "", in_range(1, 150)),
      make_param<S>("fx", &S::fx, "pixel", "", in_range(1, 1e6)),
      make_param<S>("fy", &S::fy, "pixel", "", in_range(1, 1e6)),
      make_param<S>("cx", &S::cx, "pixel", "", in_range(0, 1e6)),
      make_param<S>("cy", &S::cy, "pixel", "", in_range(0, 1e6)),
      make_param<S>("depth_scale", &S::depth_scale, "mm", "", in_range(0.001, 10)),
      make_param<S>("noise", &S::noise, "m", "", in_range(0, 0.1)),
      make_param<S>("noise_z2", &S::noise_z2, "1/m", "", in_range(0, 0.1)),
      make_param<S>("grazing_cosine", &S::grazing_cosine, "", "", in_range(0, 0.9)),
      make_param<S>("disparity_step", &S::disparity_step, "1/m", "", in_range(0, 0.1)),
      make_param<S>("edge_jump", &S::edge_jump, "m", "", in_range(0, 1)),
      make_param<S>("holes", &S::holes, "", "", in_range(0, 1000)),
      make_param<S>("window", &S::window, "pixel", "", in_range(0, 20)),
      make_param<S>("window_noise_z2", &S::window_noise_z2, "1/m", "", in_range(0, 0.1)),
      make_param<S>("window_shift", &S::window_shift, "pixel", "", in_range(0, 20)),
      make_param<S>("edge_shift", &S::edge_shift, "pixel", "", in_range(0, 20))};
  return all;
}

Sensor to_sensor(const SensorSpec& spec) {
  Sensor sensor;
  sensor.width = static_cast<std::size_t>(spec.width);
  sensor.height = static_cast<std::size_t>(spec.height);
  const double focal =
      spec.field > 0 ? spec.width / 2.0 / std::tan(spec.field * kDegree / 2) : spec.fx;
  sensor.camera = {focal, spec.fy > 0 ? spec.fy : focal,
                   spec.cx > 0 ? spec.cx : (spec.width - 1) / 2.0,
                   spec.cy > 0 ? spec.cy : (spec.height - 1) / 2.0, spec.depth_scale};
  sensor.noise = spec.noise, sensor.noise_z2 = spec.noise_z2;
  sensor.grazing_cosine = spec.grazing_cosine, sensor.disparity_step = spec.disparity_step;
  sensor.edge_jump = spec.edge_jump, sensor.holes = spec.holes;
  sensor.window = static_cast<std::size_t>(spec.window);
  sensor.window_noise_z2 = spec.window_noise_z2, sensor.window_shift = spec.window_shift;
  sensor.edge_shift = spec.edge_shift;
  return sensor;
}

Sensor read_file(const std::string& file) {
  SpecReader reader{file, {}};
  const YAML::Node root = reader.load();
  SensorSpec spec;
  if (reader.problems.empty()) reader.read_map(root, "", params(), &spec, {});
  if (reader.problems.empty() && (spec.field > 0) == (spec.fx > 0))
    reader.report({file, 1, 1}, "", "expected field [deg] or fx [pixels], one of them");
  if (!reader.problems.empty()) throw graph::ConfigError(std::move(reader.problems));
  return to_sensor(spec);
}

double field(double pixels, double focal) { return 2 * std::atan(pixels / 2 / focal) / kDegree; }

/// Of single pixels, at a distance [m].
double noise_at(const Sensor& sensor, double distance) {
  return sensor.noise + std::hypot(sensor.noise_z2, sensor.window_noise_z2) * distance * distance;
}

}  // namespace

Sensor read_sensor(const std::string& name_or_file) {
  const std::vector<std::string>& known = sensor_names();
  if (std::find(known.begin(), known.end(), name_or_file) != known.end())
    return find_sensor(name_or_file);
  if (std::filesystem::exists(name_or_file)) return read_file(name_or_file);
  const std::string near = graph::closest_name(name_or_file, known);
  throw std::invalid_argument("no sensor and no file is called '" + name_or_file + "'" +
                              (near.empty() ? "" : ", did you mean '" + near + "'?") +
                              (near.empty() ? "; " : " ") + "there are " + graph::join_list(known));
}

std::string list_sensors() {
  std::string text;
  for (const std::string& name : sensor_names()) {
    const Sensor sensor = find_sensor(name);
    text += format(
        "  %-12s %4zu x %-4zu %3.0f x %.0f deg, noise %.2g mm at 0.5 m, %.2g mm at 1 m, "
        "%.2g mm at 2 m\n",
        name.c_str(), sensor.width, sensor.height,
        field(static_cast<double>(sensor.width), sensor.camera.fx),
        field(static_cast<double>(sensor.height), sensor.camera.fy), 1000 * noise_at(sensor, 0.5),
        1000 * noise_at(sensor, 1), 1000 * noise_at(sensor, 2));
  }
  return text;
}

}  // namespace posevote
