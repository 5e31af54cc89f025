// SPDX-License-Identifier: BSD-3-Clause
// `posevote bench --growth`: how time and memory grow with what a user may have more of. The input
// is made: procedural models, and a laser scan from above of a plain strewn with them, whose points
// lie 2 mm apart however large it is. One quantity grows at a time; the exponent is the slope of
// a line through the logarithms.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "nodes/formats/write_ply.hpp"
#include "tools/bench/contestant.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/plot/line_chart.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr double kPixel = 0.002;  // between the scan's points [m]
constexpr double kDistance = 10;  // of the sensor: it looks straight down on all of the plain [m]
constexpr double kPlot = 0.2;     // edge of the square in which one body stands [m]
constexpr double kSize = 0.16;    // of a model [m]
constexpr std::size_t kPoints = 90000;  // nine plots
constexpr std::size_t kModels = 4;
const std::vector<std::string> kKinds = {"figure", "horn", "coral", "boulder"};

/// The first `count` models. Each is a file, as a user's.
std::vector<std::string> model_files(const fs::path& folder, std::size_t count) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path file = folder / ("model" + std::to_string(100 + i) + ".ply");
    if (!fs::exists(file))
      formats::write_ply(file, make_shape(kKinds[i % kKinds.size()], i / kKinds.size() + 1, kSize));
    files.push_back(file.string());
  }
  return files;
}

/// A scan of some `points` points in which the first kModels models stand, each again and again.
std::string scan_file(const fs::path& folder, std::size_t points) {
  fs::path file = folder / ("scan" + std::to_string(points) + ".ply");
  if (fs::exists(file)) return file.string();
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(points)));
  const double extent = static_cast<double>(side) * kPixel;
  const int plots = std::max(1, static_cast<int>(std::lround(extent / kPlot)));
  std::vector<Body> bodies;
  Random random(1, points);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(kKinds.size());
  for (const std::string& kind : kKinds)
    meshes.push_back(std::make_shared<const Mesh>(make_shape(kind, 1, kSize)));
  for (int i = 0; i < plots * plots; ++i) {
    Body body{meshes[static_cast<std::size_t>(i) % meshes.size()], i + 1,
              Eigen::Isometry3d::Identity()};
    const int column = i % plots, row = i / plots;
    body.T_world_body.translation() << (column + 0.5) * kPlot - extent / 2,
        (row + 0.5) * kPlot - extent / 2, kSize / 2;
    body.T_world_body.rotate(
        Eigen::AngleAxisd(random.uniform(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ()));
    bodies.push_back(body);
  }
  bodies.push_back(make_table(2 * extent));
  Sensor sensor = find_sensor("laser");
  sensor.width = sensor.height = side;
  sensor.camera.fx = sensor.camera.fy = kDistance / kPixel;
  sensor.camera.cx = sensor.camera.cy = static_cast<double>(side) / 2;
  sensor.camera.depth_scale = 0.2;  // 16 bits reach 13 m
  const SimulatedScan made =
      scan(bodies, sensor, look_at({0, 0, 0}, kDistance, std::numbers::pi / 2, 0), 1);
  formats::write_ply(file, points_of(made.depth, sensor.camera));
  return file.string();
}

/// What is measured at one place of a curve.
struct Place {
  double x = 0, seconds = 0, megabytes = 0;
};

struct Curve {
  std::string name;  ///< what grows
  std::vector<Place> places;

  double exponent(double Place::*value) const {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Place& place : places) {
      const double a = std::log(place.x), b = std::log(std::max(1e-9, place.*value));
      ++n, x += a, y += b, xx += a * a, xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
  }
};

/// From now on, peak_memory_mb() is of what comes.
void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

struct Load {
  std::size_t points = kPoints, models = kModels;
  std::vector<std::string> set;
  std::size_t threads = 0;
};

/// What grows, and how it is put into a load.
struct Quantity {
  std::string name;
  std::vector<std::size_t> values;
  std::function<void(Load&, std::size_t)> put;
};

std::vector<std::size_t> thread_counts() {
  std::vector<std::size_t> counts;
  for (std::size_t n = 1; n <= static_cast<std::size_t>(tbb::info::default_concurrency()); n *= 2)
    counts.push_back(n);
  return counts;
}

std::vector<Quantity> quantities() {
  return {
      {"points",
       {10000, 40000, 90000, 250000, 490000, 1000000},
       [](Load& load, std::size_t n) {
         load.points = n;
         load.set = {"pick_scene_features.max_points=0"};
       }},
      {"models", {1, 2, 4, 8, 16, 30}, [](Load& load, std::size_t n) { load.models = n; }},
      {"correspondences",
       {1000, 2000, 4000, 8000},
       [](Load& load, std::size_t n) {
         load.set = {"pick_scene_features.spacing=0.5", "drop_flat.min_relief=0",
                     "pick_scene_features.max_points=" + std::to_string(n)};
       }},
      {"rotations",
       {15, 30, 60, 120},
       [](Load& load, std::size_t n) { load.set = {"cast_votes.rotations=" + std::to_string(n)}; }},
      {"threads", thread_counts(), [](Load& load, std::size_t n) { load.threads = n; }}};
}

/// Throws std::invalid_argument where something else is wanted than there is.
std::vector<Quantity> choose(const std::vector<std::string>& wanted) {
  std::vector<Quantity> all = quantities(), chosen;
  for (const std::string& name : wanted) {
    if (name == "all") return all;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Quantity& one) { return one.name == name; });
    if (found == all.end())
      throw std::invalid_argument("--growth " + name +
                                  ": expected all, points, models, correspondences, rotations or "
                                  "threads");
    chosen.push_back(*found);
  }
  return chosen;
}

class Bench {
 public:
  Bench(const BenchCommand& command, fs::path folder)
      : command_(command), folder_(std::move(folder)) {
    fs::create_directories(folder_);
  }

  Curve grow(const Quantity& quantity) const {
    Curve curve{quantity.name, {}};
    for (const std::size_t number : quantity.values) {
      Load load;
      quantity.put(load, number);
      curve.places.push_back(measure(load, static_cast<double>(number)));
      const Place& last = curve.places.back();
      std::printf("%-18s %9.0f %9.3f s %7.0f MB\n", curve.name.c_str(), last.x, last.seconds,
                  last.megabytes);
      std::fflush(stdout);
    }
    return curve;
  }

 private:
  Place measure(const Load& load, double x) const {
    BenchCommand command = command_;
    command.set.insert(command.set.end(), load.set.begin(), load.set.end());
    command.set.insert(command.set.end(), {"load_models.unit=m", "load_scene.unit=m"});
    Contestant contestant = make_contestant(command, find_methods({"posevote"}).front());
    const tbb::global_control threads(
        tbb::global_control::max_allowed_parallelism,
        load.threads > 0 ? load.threads
                         : static_cast<std::size_t>(tbb::info::default_concurrency()));
    const auto scenes = list_scenes({scan_file(folder_, load.points)});
    train_once(contestant, list_models(model_files(folder_, load.models)));
    forget_peak_memory();
    for (int turn = 0; turn < command_.repeat; ++turn) run_once(contestant, scenes.front());
    return {x, median(contestant.online), static_cast<double>(peak_memory_mb())};
  }

  const BenchCommand& command_;
  fs::path folder_;
};

plot::Chart chart_of(const Curve& curve) {
  plot::Chart chart;
  char slope[32];
  std::snprintf(slope, sizeof slope, "exponent %.2f", curve.exponent(&Place::seconds));
  chart.title = slope;
  chart.x_label = curve.name;
  chart.y_label = "time of a scan [s]";
  chart.log_x = chart.log_y = true;
  chart.series = {{"posevote", {}, {}}};
  for (const Place& place : curve.places) {
    chart.series[0].x.push_back(place.x);
    chart.series[0].y.push_back(place.seconds);
  }
  return chart;
}

nlohmann::ordered_json to_json(const std::vector<Curve>& curves) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Curve& curve : curves)
    for (const Place& place : curve.places)
      rows.push_back({{"grows", curve.name},
                      {"value", place.x},
                      {"seconds", place.seconds},
                      {"peak_mb", place.megabytes},
                      {"exponent", curve.exponent(&Place::seconds)}});
  return rows;
}

}  // namespace

nlohmann::ordered_json bench_growth(const BenchCommand& command) {
  const std::vector<Quantity> chosen = choose(command.growth);
  const std::string base = command.out.empty() ? "out/growth" : command.out;
  const Bench bench(command, base + "_input");
  std::vector<Curve> curves;
  curves.reserve(chosen.size());
  for (const Quantity& quantity : chosen) curves.push_back(bench.grow(quantity));
  std::printf("\n%-18s %14s %16s\n", "", "time exponent", "memory exponent");
  std::vector<plot::Chart> charts;
  for (const Curve& curve : curves) {
    std::printf("%-18s %14.2f %16.2f\n", curve.name.c_str(), curve.exponent(&Place::seconds),
                curve.exponent(&Place::megabytes));
    charts.push_back(chart_of(curve));
  }
  const nlohmann::ordered_json rows = to_json(curves);
  write_report(base, rows.dump(1) + "\n", to_csv(rows), plot::to_svg(charts));
  return rows;
}

}  // namespace posevote
