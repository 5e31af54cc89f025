// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "graph/parallel.hpp"
#include "tools/simulate/random.hpp"

namespace posevote {
namespace {

const std::map<std::string, Sensor>& sensors() {
  static const std::map<std::string, Sensor> known = [] {
    // Its image has fine units, so that rounding adds nothing to its noise.
    const Camera fine{1100, 1100, 399.5, 299.5, 0.05};
    Sensor laser{800, 600, fine, 0.0003, 0, 0.17, 0, 0, 0, false};
    // A stripe that is moved by hand: coarser and uneven from row to row.
    Sensor sweep{800, 600, fine, 0.0005, 0, 0.2, 0, 0, 0, true};
    // A Kinect: disparity in eighths of a pixel, noise of half such a step (Khoshelham, Elberink
    // 2012, eq. 11), the projector's shadow beside edges, holes.
    Sensor rgbd{640, 480,  {570, 570, 319.5, 239.5, 1.0}, 0, 0.001425, 0.2, 0.00285, 0.02,
                12,  false};
    // The same in what it does to surfaces and edges, which matching by windows of speckles bends
    // (Handa et al. 2014, ICL-NUIM; Barron, Malik 2013): normals lie off by some degrees over a
    // centimetre and more, and silhouettes run up to five pixels beside their surfaces (a deviation
    // of 2.5, and one farther out on the whole), as in the real images of YCB-Video, LM-O and IC-BIN.
    Sensor speckle{
        640, 480, {570, 570, 319.5, 239.5, 0.1}, 0, 0.0002, 0.2, 0.0007, 0.02, 12, false, 5, 0.0014,
        1,   2.5};
    // Noise alone, as much as a scene asks for: what methods do under it can be told.
    Sensor plain{640, 480, {570, 570, 319.5, 239.5, 0.05}, 0.001, 0, 0.2, 0, 0, 0, false};
    // Kinds of sensors with usual figures, of no one product. Structured light for workpieces: fine
    // and exact, blind beside edges, where its projector does not reach.
    Sensor structured{1024, 768,  {1400, 1400, 511.5, 383.5, 0.05}, 0.00003, 0.00007, 0.2, 0, 0.01,
                      4,    false};
    // Time of flight: coarse errors that grow slowly; nothing behind edges, where pixels mix.
    Sensor flight{640, 576, {504, 504, 319.5, 287.5, 0.5}, 0.001, 0.001, 0.15, 0, 0.03, 8, false};
    // Active stereo: matched by windows, so that surfaces are bent and edges run.
    Sensor stereo{
        848,   480, {640, 640, 423.5, 239.5, 0.5}, 0, 0.0003, 0.2, 0.0004, 0.02, 12, false, 3,
        0.001, 1};
    return std::map<std::string, Sensor>{{"laser", laser}, {"sweep", sweep},
                                         {"rgbd", rgbd},   {"speckle", speckle},
                                         {"plain", plain}, {"structured_light", structured},
                                         {"tof", flight},  {"stereo", stereo}};
  }();
  return known;
}

/// What the sensor reports of a hit in units of its image; 0: nothing. `shared`: the error that it
/// has in common with its neighbours, in deviations.
std::uint16_t measure(double depth, double cosine, double ray_length, double shared,
                      const Sensor& sensor, Random random) {
  if (depth <= 0 || cosine < sensor.grazing_cosine) return 0;
  const double distance = depth * ray_length;
  const double deviation = sensor.noise + sensor.noise_z2 * distance * distance;
  double measured = depth + deviation * random.normal() / ray_length +
                    sensor.window_noise_z2 * depth * depth * shared;
  if (sensor.disparity_step > 0)
    measured = 1 / (sensor.disparity_step *
                    std::max(1.0, std::round(1 / (measured * sensor.disparity_step))));
  const double raw = std::round(measured * 1000 / sensor.camera.depth_scale);
  return raw >= 1 && raw <= 65535 ? static_cast<std::uint16_t>(raw) : std::uint16_t{0};
}

/// Sums over rows of `width` weighted by a triangle of half-width `window`, as many fewer a row;
/// transposed, so that a second pass does the columns. White noise keeps its deviation.
std::vector<double> blur_rows(const std::vector<double>& from, std::size_t width,
                              std::size_t window) {
  std::vector<double> weights;
  double squares = 0;
  for (std::size_t i = 0; i <= 2 * window; ++i) {
    weights.push_back(static_cast<double>(std::min(i, 2 * window - i) + 1));
    squares += weights.back() * weights.back();
  }
  const std::size_t height = from.size() / width, left = width - 2 * window;
  std::vector<double> out(left * height);
  graph::parallel_for(height, 16, [&](std::size_t v) {
    for (std::size_t u = 0; u < left; ++u) {
      double sum = 0;
      for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * from[v * width + u + i];
      out[u * height + v] = sum / std::sqrt(squares);
    }
  });
  return out;
}

/// Noise of deviation 1 that pixels less than two windows apart have in part in common; row by row.
std::vector<double> shared_noise(const Sensor& sensor, Random random) {
  const std::size_t width = sensor.width + 2 * sensor.window;
  const std::size_t height = sensor.height + 2 * sensor.window;
  std::vector<double> white(width * height);
  for (double& value : white) value = random.normal();
  return blur_rows(blur_rows(white, width, sensor.window), height, sensor.window);
}

/// What all pixels share with their neighbours: errors of depth and of where they look, on surfaces
/// and beside edges. Empty where the sensor has no windows.
struct SharedErrors {
  std::vector<double> depth, x, y, edge_x, edge_y;

  SharedErrors(const Sensor& sensor, std::uint64_t seed, std::uint64_t stream) {
    if (sensor.window == 0) return;
    depth = shared_noise(sensor, Random(seed, stream));
    x = shared_noise(sensor, Random(seed, stream + 1));
    y = shared_noise(sensor, Random(seed, stream + 2));
    if (sensor.edge_shift == 0) return;
    edge_x = shared_noise(sensor, Random(seed, stream + 3));
    edge_y = shared_noise(sensor, Random(seed, stream + 4));
  }
  double depth_at(std::size_t pixel) const { return depth.empty() ? 0 : depth[pixel]; }
  /// The pixel whose ray meets what this one reports.
  std::size_t looks_at(std::size_t pixel, const TrueDepth& truth, const Sensor& sensor) const {
    if (depth.empty()) return pixel;
    const std::size_t here =
        moved(pixel, sensor.window_shift * x[pixel], sensor.window_shift * y[pixel], sensor);
    if (edge_x.empty()) return here;
    const std::size_t there = nearest_beside(
        moved(pixel, sensor.edge_shift * edge_x[pixel], sensor.edge_shift * edge_y[pixel], sensor),
        truth, sensor);
    constexpr double kEdge = 0.02;  // [m]
    return std::abs(truth.depth[there] - truth.depth[here]) > kEdge ? there : here;
  }

 private:
  static std::size_t moved(std::size_t pixel, double x, double y, const Sensor& sensor) {
    const auto step = [](std::size_t place, double by, std::size_t end) {
      const double at = static_cast<double>(place) + std::round(by);
      return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(end - 1)));
    };
    return step(pixel / sensor.width, y, sensor.height) * sensor.width +
           step(pixel % sensor.width, x, sensor.width);
  }
  /// Of a pixel and the four beside it: windows that reach over an edge match what is in front.
  static std::size_t nearest_beside(std::size_t pixel, const TrueDepth& truth,
                                    const Sensor& sensor) {
    std::size_t nearest = pixel;
    for (const auto& [x, y] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const std::size_t beside = moved(pixel, x, y, sensor);
      if (truth.depth[beside] > 0 &&
          (truth.depth[nearest] == 0 || truth.depth[beside] < truth.depth[nearest]))
        nearest = beside;
    }
    return nearest;
  }
};

/// Whether a neighbour in the row stands out before the pixel: one of the two eyes is blind there.
bool behind_edge(const TrueDepth& truth, const Sensor& sensor, std::size_t u, std::size_t v) {
  if (sensor.edge_jump <= 0) return false;
  const std::size_t row = v * sensor.width;
  const double here = truth.depth[row + u];
  for (std::size_t x = u > 0 ? u - 1 : u; x <= std::min(u + 1, sensor.width - 1); ++x)
    if (const double there = truth.depth[row + x]; there > 0 && here - there > sensor.edge_jump)
      return true;
  return false;
}

void punch_holes(formats::DepthImage& image, int holes, Random random) {
  constexpr double kLeast = 2, kMost = 7;  // radius [pixels]
  const auto width = static_cast<double>(image.width), height = static_cast<double>(image.height);
  for (int i = 0; i < holes; ++i) {
    const double x = random.uniform(0, width), y = random.uniform(0, height);
    const double radius = random.uniform(kLeast, kMost);
    for (std::size_t pixel = 0; pixel < image.values.size(); ++pixel) {
      const std::size_t u = pixel % image.width, v = pixel / image.width;
      const double dx = static_cast<double>(u) - x, dy = static_cast<double>(v) - y;
      if (dx * dx + dy * dy < radius * radius) image.values[pixel] = 0;
    }
  }
}

/// Keeps a row each time the stripe has moved on by one: fast where the wave is high.
void thin_rows(formats::DepthImage& image, Random random) {
  const double phase = random.uniform(0, 6.283185307179586);
  double moved = 0;
  for (std::size_t v = 0; v < image.height; ++v) {
    const double part = static_cast<double>(v) / static_cast<double>(image.height);
    moved += 0.7 + 0.3 * std::sin(phase + 12 * part);  // 0.4 to 1 of the rows
    if (moved >= 1) {
      moved -= 1;
      continue;
    }
    const auto row = image.values.begin() + static_cast<std::ptrdiff_t>(v * image.width);
    std::fill(row, row + static_cast<std::ptrdiff_t>(image.width), std::uint16_t{0});
  }
}

}  // namespace

const std::vector<std::string>& sensor_names() {
  static const std::vector<std::string> names{"laser", "structured_light", "rgbd",  "stereo",
                                              "tof",   "speckle",          "sweep", "plain"};
  return names;
}

Sensor find_sensor(const std::string& name) {
  const auto found = sensors().find(name);
  if (found == sensors().end()) throw std::invalid_argument("no sensor is called " + name);
  return found->second;
}

Eigen::Vector3d ray_of(const Camera& camera, double u, double v) {
  return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1};
}

formats::DepthImage take_image(const TrueDepth& truth, const Sensor& sensor, std::uint64_t seed) {
  formats::DepthImage image{sensor.width, sensor.height,
                            std::vector<std::uint16_t>(truth.depth.size())};
  const std::uint64_t beyond = truth.depth.size();  // streams that no pixel has
  const SharedErrors shared(sensor, seed, beyond + 2);
  graph::parallel_for(sensor.height, 4, [&](std::size_t v) {
    for (std::size_t u = 0; u < sensor.width; ++u) {
      const std::size_t pixel = v * sensor.width + u;
      const std::size_t hit = shared.looks_at(pixel, truth, sensor);
      if (behind_edge(truth, sensor, hit % sensor.width, hit / sensor.width)) continue;
      image.values[pixel] = measure(truth.depth[hit], truth.cosine[hit],
                                    ray_of(sensor.camera, double(u), double(v)).norm(),
                                    shared.depth_at(pixel), sensor, Random(seed, pixel));
    }
  });
  punch_holes(image, sensor.holes, Random(seed, beyond));
  if (sensor.uneven) thin_rows(image, Random(seed, beyond + 1));
  return image;
}

}  // namespace posevote
