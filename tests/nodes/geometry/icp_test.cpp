// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/icp.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/support/bumpy_scene.hpp"

namespace posevote::icp_test {

using namespace posevote::test;

namespace {

const geometry::IcpParams kParams{40, 5 * kResolution, 2 * kResolution};
constexpr float kReach = 5 * kResolution;

/// `moved` relative to `truth`: how far the origin is off [m], and the turn [rad].
struct Error {
  double shift, turn;
};
Error error_of(const Eigen::Isometry3d& moved, const Eigen::Isometry3d& truth) {
  const Eigen::Isometry3d between = truth.inverse() * moved;
  return {between.translation().norm(), Eigen::AngleAxisd(between.linear()).angle()};
}

/// A square patch z = 1 + noise that looks at the sensor in the origin.
Cloud noisy_plane(float half_width, float noise, float tilt) {
  std::mt19937 random(3);
  const auto uniform = [&random] { return static_cast<float>(random()) / 2147483648.0F - 1.0F; };
  const int side = static_cast<int>(2 * half_width / kResolution);
  Cloud cloud;
  cloud.points.resize(side * side, 3);
  cloud.normals.resize(side * side, 3);
  for (int i = 0; i < side * side; ++i) {
    cloud.points.row(i) << static_cast<float>(i % side) * kResolution - half_width,
        static_cast<float>(i / side) * kResolution - half_width, 1.0F + noise * uniform();
    cloud.normals.row(i) = Eigen::RowVector3f(tilt * uniform(), tilt * uniform(), -1).normalized();
  }
  return cloud;
}

}  // namespace

TEST_CASE("ICP converges from 3 deg and 5 mm", "[segment]") {
  const Placed body{1, pose(-0.05, 0.01, 0.8, 0.7)};
  const auto model = bumpy_model(1);
  const geometry::ScanSurface surface(scan_of({body}), true, kReach);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d offset = 0.005 * Eigen::Vector3d::Unit(axis);
    const Eigen::Isometry3d start =
        body.T_scene_model *
        pose(offset.x(), offset.y(), offset.z(), 0.0524, Eigen::Vector3d::Unit((axis + 1) % 3));
    const Error error =
        error_of(geometry::icp(model->cloud, surface, start, kParams), body.T_scene_model);
    CHECK(error.shift < 0.1 * kResolution);
    CHECK(error.turn < 0.003);
  }
}

TEST_CASE("few points find the way, many the place", "[segment]") {
  const Placed body{1, pose(-0.05, 0.01, 0.8, 0.7)};
  const auto model = bumpy_model(1);
  Cloud scan = scan_of({body});
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0, 0.5F * kResolution);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    scan.points.row(i) += noise(random) * scan.normals.row(i);
  const geometry::ScanSurface surface(scan, true, kReach);
  geometry::IcpParams few = kParams, many = kParams;
  few.samples = 200;
  many.samples = model->cloud.points.rows();
  many.start_distance = many.end_distance;  // all points from the first iteration on
  double by_few = 0, by_many = 0;
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5 * i;
    const Eigen::Isometry3d start =
        body.T_scene_model * pose(0.004 * std::cos(angle), 0.004 * std::sin(angle), 0, 0.03);
    const Eigen::Isometry3d near = geometry::icp(model->cloud, surface, start, few);
    by_few += error_of(near, body.T_scene_model).shift;
    by_many += error_of(geometry::icp(model->cloud, surface, near, many), body.T_scene_model).shift;
  }
  CHECK(by_few / 12 < 0.5 * kResolution);
  CHECK(by_many < 0.7 * by_few);
}

TEST_CASE("ICP holds a body of which a quarter is left", "[segment]") {
  const Placed body{2, pose(0, 0, 0.8, 1.7)};
  const Placed before{3, pose(0.035, 0.02, 0.6, 0.2)};
  const Cloud scan = scan_of({body, before});
  const auto model = bumpy_model(2);
  const geometry::ScanSurface surface(scan, true, kReach);
  const Eigen::Isometry3d start = body.T_scene_model * pose(0.003, -0.002, 0.003, 0.05);
  const Error error =
      error_of(geometry::icp(model->cloud, surface, start, kParams), body.T_scene_model);
  CHECK(error.shift < 0.2 * kResolution);
  CHECK(error.turn < 0.01);
}

TEST_CASE("on a plane ICP settles in depth and does not slide", "[segment]") {
  const Cloud patch = noisy_plane(0.03F, 0, 0);
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.translation() << 0.01, -0.02, 0.006;
  for (const float noise : {0.0F, 1.0F}) {
    const Cloud scan = noisy_plane(0.2F, 0.001F * noise, 0.1F * noise);
    const geometry::ScanSurface surface(scan, true, kReach);
    const Eigen::Isometry3d end = geometry::icp(patch, surface, start, kParams);
    CHECK(std::abs(end.translation().z()) < 0.0003);
    CHECK((end.translation() - start.translation()).head<2>().norm() < 1e-6 + 0.003 * noise);
    CHECK(Eigen::AngleAxisd(end.linear()).angle() < 1e-6 + 0.02 * noise);
  }
}

TEST_CASE("ICP goes all the way where little holds it", "[segment]") {
  const auto ripple = [](Cloud cloud) {  // slopes of 1.3 deg along x
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
      const float phase = cloud.points(i, 0) / 0.01F;
      cloud.points(i, 2) += 0.0003F * std::cos(phase);
      cloud.normals.row(i) = Eigen::RowVector3f(-0.03F * std::sin(phase), 0, -1).normalized();
    }
    return cloud;
  };
  const geometry::ScanSurface surface(ripple(noisy_plane(0.2F, 0, 0)), true, kReach);
  const Eigen::Isometry3d start(Eigen::Translation3d(0.005, 0, 0));
  const Eigen::Isometry3d end =
      geometry::icp(ripple(noisy_plane(0.06F, 0, 0)), surface, start, kParams);
  CHECK(std::abs(end.translation().x()) < 0.0005);
}

TEST_CASE("sides whose points come in turns all hold ICP", "[segment]") {
  // A box from the sensor's right: its front, and its left side, of which every second point is one
  // of the right side.
  constexpr int kEdge = 40;
  Cloud box;
  box.points.resize(3 * kEdge * kEdge, 3);
  box.normals.resize(3 * kEdge * kEdge, 3);
  for (int i = 0; i < kEdge * kEdge; ++i) {
    const float a = static_cast<float>(i % kEdge) * kResolution;
    const float b = static_cast<float>(i / kEdge) * kResolution;
    constexpr float kFar = kEdge * kResolution;
    box.points.row(2 * i) << kFar, a, b;
    box.normals.row(2 * i) << 1, 0, 0;
    box.points.row(2 * i + 1) << 0, a, b;
    box.normals.row(2 * i + 1) << -1, 0, 0;
    box.points.row(2 * kEdge * kEdge + i) << a, b, 0;
    box.normals.row(2 * kEdge * kEdge + i) << 0, 0, -1;
  }
  const Eigen::Isometry3d truth(Eigen::Translation3d(0.3, 0, 0.6));
  Cloud scan = box;
  scan.points.rowwise() += truth.translation().transpose().cast<float>();
  const geometry::ScanSurface surface(scan, true, kReach);
  const Eigen::Isometry3d start = truth * pose(0.7 * kResolution, 0, 0, 0);
  for (const int share : {2, 3, 4, 8}) {
    geometry::IcpParams params = kParams;
    params.samples = box.points.rows() / share + 1;
    const Error error = error_of(geometry::icp(box, surface, start, params), truth);
    CHECK(error.shift < 0.05 * kResolution);
  }
}

TEST_CASE("without partners ICP returns its start", "[segment]") {
  const Placed body{1, pose(0, 0, 0.8, 0)};
  const auto model = bumpy_model(1);
  const Cloud scan = scan_of({body});
  const Eigen::Isometry3d far = pose(5, 0, 5, 1);
  CHECK(geometry::icp(model->cloud, geometry::ScanSurface(scan, true, kReach), far, kParams)
            .isApprox(far));
  const std::vector<char> all(static_cast<std::size_t>(scan.points.rows()), 1);
  geometry::ScanSurface nothing(scan, true, kReach);
  nothing.take_out(all);
  CHECK(geometry::icp(model->cloud, nothing, body.T_scene_model, kParams)
            .isApprox(body.T_scene_model));
  CHECK(geometry::icp(Cloud{}, nothing, far, kParams).isApprox(far));
}

TEST_CASE("points and normals that are not finite do not reach the pose", "[segment]") {
  const Placed body{1, pose(0, 0, 0.8, 0.3)};
  Cloud scan = scan_of({body});
  scan.points.row(7).setConstant(std::nanf(""));
  scan.normals.row(9).setConstant(std::nanf(""));
  Cloud model = bumpy_model(1)->cloud;
  model.points.row(3).setConstant(std::nanf(""));
  model.normals.row(4).setConstant(std::nanf(""));
  const geometry::ScanSurface surface(scan, true, kReach);
  const Eigen::Isometry3d end = geometry::icp(model, surface, body.T_scene_model, kParams);
  CHECK(end.matrix().allFinite());
  CHECK(error_of(end, body.T_scene_model).shift < 0.1 * kResolution);
}

TEST_CASE("ICP ends where partners only come and go, and follows what slides if asked",
          "[segment]") {
  const Cloud model = noisy_plane(0.03F, 0, 0);
  const geometry::ScanSurface surface(noisy_plane(0.06F, 0, 0), true, kReach);
  int calls = 0;
  // A pull along the plane, where nothing else holds it: to and fro, or one way.
  const auto pull = [&](bool alternates) {
    return [&calls, alternates](const Eigen::Isometry3d& T_scene_model, double) {
      const double side = alternates && ++calls % 2 == 0 ? 1 : -1;
      std::vector<geometry::IcpPair> pairs;
      for (const double y : {-0.02, 0.02}) {
        geometry::IcpPair& pair = pairs.emplace_back();
        pair.point = T_scene_model * Eigen::Vector3d(0, y, 1);
        pair.normal = Eigen::Vector3d::UnitX();
        pair.residual = 0.2 * side * static_cast<double>(kResolution);
        pair.weight = 100;
      }
      return pairs;
    };
  };
  const auto steps_of = [&](const geometry::MorePairs& more, bool follows_drift) {
    geometry::IcpParams params = kParams;
    params.follows_drift = follows_drift;
    int steps = 0;
    geometry::icp(
        model, surface, Eigen::Isometry3d::Identity(), params,
        [&steps](const Eigen::Isometry3d&) { ++steps; }, more);
    return steps;
  };
  CHECK(steps_of(pull(true), true) < 20);
  CHECK(steps_of(pull(true), false) < 20);
  CHECK(steps_of(pull(false), false) < 20);
  CHECK(steps_of(pull(false), true) == kParams.iterations);
}

}  // namespace posevote::icp_test
