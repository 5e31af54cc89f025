// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "tools/simulate/scanner.hpp"
#include "tools/simulate/surface_nets.hpp"

namespace posevote::simulate_scanner_test {
namespace {

Body ball(double radius, const Eigen::Vector3d& center) {
  const double r = radius;
  const auto mesh = std::make_shared<Mesh>(
      surface_nets([r](const Eigen::Vector3d& p) { return p.norm() - r; }, 1.3 * r, r / 40));
  Body body{mesh, 1, Eigen::Isometry3d::Identity()};
  body.T_world_body.translation() = center;
  return body;
}

const Eigen::Isometry3d kAtOrigin = Eigen::Isometry3d::Identity();

/// A wall 1 m away that steps back in the middle of each row, at column 320.
TrueDepth step_back(const Sensor& sensor, double behind) {
  const std::size_t pixels = sensor.width * sensor.height;
  TrueDepth truth{std::vector<double>(pixels, 1.0), std::vector<double>(pixels, 1.0)};
  for (std::size_t i = 0; i < pixels; ++i)
    if (i % sensor.width >= 320) truth.depth[i] = behind;
  return truth;
}

/// How far from there each row has its first pixel that reports at least as much.
std::vector<double> steps_off(const formats::DepthImage& image, std::uint16_t least) {
  std::vector<double> off;
  for (std::size_t v = 0; v < image.height; ++v) {
    std::size_t edge = 300;
    while (image.values[v * image.width + edge] < least) ++edge;
    off.push_back(static_cast<double>(edge) - 320);
  }
  return off;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double square_of(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
         static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("the points of a scanned ball lie on it, within the noise", "[simulate]") {
  for (const std::string& name : sensor_names()) {
    INFO(name);
    const Sensor sensor = find_sensor(name);
    const Eigen::Vector3d center(0.03, -0.02, 0.8);
    const SimulatedScan seen = scan({ball(0.1, center)}, sensor, kAtOrigin, 1);
    const Scan cloud = points_of(seen.depth, sensor.camera);
    const double pixels = std::numbers::pi * std::pow(0.1 * sensor.camera.fx / 0.8, 2);
    CHECK(seen.views[0].alone == Approx(pixels).epsilon(0.05));
    const double beside = 4 * sensor.edge_shift * 0.8 / sensor.camera.fx;
    double sum = 0, squares = 0;
    int frontal = 0;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
      const Eigen::Vector3d point = cloud.points.row(i).transpose().cast<double>();
      const double off = (point - center).norm() - 0.1;
      CHECK(std::abs(off) < 0.008 + beside);
      if ((point - center).normalized().dot(-point.normalized()) < 0.9) continue;
      sum += off, squares += off * off;
      ++frontal;
    }
    const std::map<std::string, double> expected{
        {"laser", 0.0003},
        {"sweep", 0.0005},
        {"rgbd", std::hypot(0.001425 * 0.5, 0.00285 * 0.5 / 3.46, 0.001 / 3.46)},
        {"speckle", std::hypot(0.0014 * 0.5, 0.0002 * 0.5, 0.0007 * 0.5 / 3.46)},
        {"structured_light", std::hypot(0.00003 + 0.00007 * 0.5, 0.00005 / 3.46)},
        {"tof", std::hypot(0.001 + 0.001 * 0.5, 0.0005 / 3.46)},
        {"stereo",
         std::hypot(std::hypot(0.001 * 0.5, 0.0003 * 0.5, 0.0004 * 0.5 / 3.46), 0.0005 / 3.46)},
        {"plain", 0.001}};
    REQUIRE(frontal > 1000);
    CHECK(std::abs(sum / frontal) < 0.0002);
    CHECK(std::sqrt(squares / frontal) == Approx(expected.at(name)).epsilon(0.15));
  }
}

TEST_CASE("visible fractions: half behind, wholly behind, in front", "[simulate]") {
  Sensor sensor = find_sensor("laser");
  const Body far = ball(0.1, {0, 0, 1.0});
  Body wall{std::make_shared<Mesh>(*make_table(1).mesh), 0, Eigen::Isometry3d::Identity()};
  wall.T_world_body.translation() = Eigen::Vector3d(0.5, 0, 0.7);  // covers x > 0
  const SimulatedScan half = scan({far, wall}, sensor, kAtOrigin, 1);
  CHECK(half.views[0].fraction() == Approx(0.5).margin(0.01));
  CHECK(half.views[0].box_visible.width == Approx(half.views[0].box_alone.width / 2.0).margin(2));
  wall.T_world_body.translation().x() = 0;
  CHECK(scan({far, wall}, sensor, kAtOrigin, 1).views[0].visible == 0);
  wall.T_world_body.translation().z() = 1.3;
  CHECK(scan({far, wall}, sensor, kAtOrigin, 1).views[0].fraction() == 1);
}

TEST_CASE("what lies beside the image is not visible", "[simulate]") {
  const Sensor sensor = find_sensor("laser");
  const double edge = -sensor.camera.cx / sensor.camera.fx;  // of the image, 1 m away
  const BodyView half = scan({ball(0.1, {edge, 0, 1})}, sensor, kAtOrigin, 1).views[0];
  CHECK(half.fraction() == Approx(0.5).margin(0.02));
  CHECK(half.box_alone.x == Approx(-half.box_visible.width).margin(10));
  CHECK(half.valid <= half.visible);
  const BodyView none = scan({ball(0.1, {edge - 0.2, 0, 1})}, sensor, kAtOrigin, 1).views[0];
  CHECK(none.alone > 0);
  CHECK(none.visible == 0);
}

TEST_CASE("surfaces seen at a grazing angle give no return", "[simulate]") {
  Body plane = make_table(10);  // horizontal, 0.1 m below the sensor's axis
  plane.T_world_body = Eigen::Translation3d(0, 0.1, 2) *
                       Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX());
  const Sensor sensor = find_sensor("laser");
  const Scan cloud = points_of(scan({plane}, sensor, kAtOrigin, 1).depth, sensor.camera);
  REQUIRE(cloud.points.rows() > 1000);
  const Eigen::VectorXf cosines = 0.1F * cloud.points.rowwise().norm().cwiseInverse();
  CHECK(cosines.minCoeff() > sensor.grazing_cosine - 0.01);
}

TEST_CASE("the sensor looks at its target, upright", "[simulate]") {
  const Eigen::Vector3d target(0.1, 0.2, 0.05);
  const Eigen::Isometry3d T_world_sensor = look_at(target, 0.9, 0.8, 2.0);
  CHECK((T_world_sensor.inverse() * target - Eigen::Vector3d(0, 0, 0.9)).norm() < 1e-12);
  CHECK(T_world_sensor.linear().determinant() == Approx(1));
  CHECK(T_world_sensor.translation().z() == Approx(0.05 + 0.9 * std::sin(0.8)));
  CHECK(T_world_sensor.linear()(2, 1) < 0);  // image down is world down
}

TEST_CASE("of a far ball's surface nearly half is seen, of a hidden one's nothing", "[simulate]") {
  const Sensor sensor = find_sensor("laser");
  const Body near = ball(0.1, {0, 0, 1.0}), hidden = ball(0.05, {0, 0, 1.5});
  const SimulatedScan seen = scan({near, hidden}, sensor, kAtOrigin, 1);
  CHECK(seen.views[0].surface == Approx(0.45).margin(0.01));  // (1 - r / d) / 2: a spherical cap
  CHECK(seen.views[1].surface == 0);
  // Half out of the image.
  const double left_border = -sensor.camera.cx / sensor.camera.fx;
  const SimulatedScan cut = scan({ball(0.1, {left_border, 0, 1.0})}, sensor, kAtOrigin, 1);
  CHECK(cut.views[0].surface == Approx(0.225).margin(0.03));
}

TEST_CASE("an RGB-D image has shadows beside edges, holes and steps of disparity", "[simulate]") {
  Sensor sensor = find_sensor("rgbd");
  sensor.noise_z2 = 0;
  const std::size_t pixels = sensor.width * sensor.height, row = 100 * sensor.width;
  TrueDepth truth{std::vector<double>(pixels, 1.0), std::vector<double>(pixels, 1.0)};
  for (std::size_t i = 0; i < pixels; ++i)
    if (i % sensor.width >= 300 && i % sensor.width < 310) truth.depth[i] = 0.9;
  sensor.holes = 0;
  const formats::DepthImage image = take_image(truth, sensor, 3);
  CHECK(image.values[row + 299] == 0);
  CHECK(image.values[row + 310] == 0);
  for (const std::size_t u : {298U, 300U, 309U, 311U}) CHECK(image.values[row + u] != 0);
  const double steps = 1 / (0.9 * sensor.disparity_step);
  CHECK(image.values[row + 305] == std::lround(1000 / (sensor.disparity_step * std::round(steps))));
  CHECK(std::count(image.values.begin(), image.values.end(), 0) ==
        static_cast<std::ptrdiff_t>(2 * sensor.height));
  sensor.holes = 12;
  const formats::DepthImage with_holes = take_image(truth, sensor, 3);
  const auto missing = std::count(with_holes.values.begin(), with_holes.values.end(), 0);
  CHECK(missing > static_cast<std::ptrdiff_t>(2 * sensor.height + 100));
  CHECK(missing < static_cast<std::ptrdiff_t>(2 * sensor.height + 12 * 160));
}

TEST_CASE("pixels of a speckle camera share their errors with their neighbours", "[simulate]") {
  Sensor sensor = find_sensor("speckle");
  sensor.noise_z2 = sensor.disparity_step = 0;
  sensor.holes = 0;
  const std::size_t pixels = sensor.width * sensor.height;
  const formats::DepthImage image =
      take_image(step_back(sensor, 1.01), sensor, 3);  // no shadow behind so low a step
  double squares = 0, beside = 0, apart = 0;
  for (std::size_t i = 0; i + 300 < pixels; ++i) {
    if (i % sensor.width >= 300) continue;
    const auto off = [&](std::size_t k) { return image.values[k] * 0.0001 - 1; };
    squares += off(i) * off(i);
    beside += off(i) * off(i + 1);
    if (i % sensor.width < 300 - 4 * sensor.window) apart += off(i) * off(i + 4 * sensor.window);
  }
  const double count = 300.0 * static_cast<double>(sensor.height);
  CHECK(std::sqrt(squares / count) == Approx(sensor.window_noise_z2).epsilon(0.1));
  CHECK(beside / squares > 0.9);
  CHECK(std::abs(apart / squares) < 0.1);
  // Errors are some millimetres, the step ten: where it lies in each row can be told.
  const std::vector<double> off_step = steps_off(image, 10050);
  CHECK(320 + mean_of(off_step) == Approx(320).margin(1.5));
  CHECK(std::sqrt(square_of(off_step)) > 0.4);
  CHECK(std::sqrt(square_of(off_step)) < 3);
}

TEST_CASE("what stands in front of a speckle camera ends some pixels beside its edge",
          "[simulate]") {
  Sensor sensor = find_sensor("speckle");
  sensor.edge_jump = 0;
  sensor.holes = 0;
  const std::vector<double> off = steps_off(take_image(step_back(sensor, 1.2), sensor, 3), 11000);
  const double mean = mean_of(off), spread = std::sqrt(square_of(off) - mean * mean);
  CHECK(mean > 0.3);
  CHECK(mean < 3);
  CHECK(spread > 1.2);
  CHECK(spread < 3.5);
}

TEST_CASE("the sweep leaves rows out, unevenly", "[simulate]") {
  const Sensor sensor = find_sensor("sweep");
  const std::size_t pixels = sensor.width * sensor.height;
  const TrueDepth truth{std::vector<double>(pixels, 1.0), std::vector<double>(pixels, 1.0)};
  const formats::DepthImage image = take_image(truth, sensor, 1);
  constexpr std::size_t kBand = 60;
  std::vector<int> kept(sensor.height / kBand);
  for (std::size_t v = 0; v < kept.size() * kBand; ++v)
    kept[v / kBand] += image.values[v * sensor.width] != 0;
  const auto [least, most] = std::minmax_element(kept.begin(), kept.end());
  CHECK(*least < 32);
  CHECK(*least > 20);
  CHECK(*most > 50);
}

}  // namespace posevote::simulate_scanner_test
