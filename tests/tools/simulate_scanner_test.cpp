// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tools/simulate/scanner.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/surface_nets.hpp"

using namespace posevote;

namespace {

Body ball(double radius, const Eigen::Vector3d& center) {
  const double r = radius;
  const auto mesh = std::make_shared<Cloud>(
      surface_nets([r](const Eigen::Vector3d& p) { return p.norm() - r; }, 1.3 * r, r / 40));
  Body body{mesh, 1, Eigen::Isometry3d::Identity()};
  body.T_world_body.translation() = center;
  return body;
}

/// 1 inside a closed mesh, 0 outside: the solid angle that it covers, over 4 pi (van Oosterom,
/// Strackee 1983).
double winding_number(const Cloud& mesh, const Eigen::Vector3d& point) {
  double sum = 0;
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k)
      m.col(k) = mesh.points.row(mesh.faces(face, k)).transpose().cast<double>() - point;
    const Eigen::RowVector3d length = m.colwise().norm();
    sum += std::atan2(m.determinant(), length.prod() + m.col(0).dot(m.col(1)) * length[2] +
                                           m.col(1).dot(m.col(2)) * length[0] +
                                           m.col(2).dot(m.col(0)) * length[1]);
  }
  return sum / (2 * std::numbers::pi);
}

const Eigen::Isometry3d kAtOrigin = Eigen::Isometry3d::Identity();

}  // namespace

TEST_CASE("the points of a scanned ball lie on it, within the noise", "[simulate]") {
  for (const std::string& name : sensor_names()) {
    INFO(name);
    const Sensor sensor = find_sensor(name);
    const Eigen::Vector3d center(0.03, -0.02, 0.8);
    const Scan seen = scan({ball(0.1, center)}, sensor, kAtOrigin, 1);
    const Cloud cloud = points_of(seen.depth, sensor.camera);
    const double pixels = std::numbers::pi * std::pow(0.1 * sensor.camera.fx / 0.8, 2);
    CHECK(seen.views[0].alone == Approx(pixels).epsilon(0.05));
    double sum = 0, squares = 0;
    int frontal = 0;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
      const Eigen::Vector3d point = cloud.points.row(i).transpose().cast<double>();
      const double off = (point - center).norm() - 0.1;
      CHECK(std::abs(off) < 0.008);
      if ((point - center).normalized().dot(-point.normalized()) < 0.9) continue;
      sum += off, squares += off * off;
      ++frontal;
    }
    const double expected = name == "laser" ? 0.0003 : std::hypot(0.001425 * 0.5, 0.001 / 3.46);
    REQUIRE(frontal > 1000);
    CHECK(std::abs(sum / frontal) < 0.0002);
    CHECK(std::sqrt(squares / frontal) == Approx(expected).epsilon(0.15));
  }
}

TEST_CASE("visible fractions: half behind, wholly behind, in front", "[simulate]") {
  Sensor sensor = find_sensor("laser");
  const Body far = ball(0.1, {0, 0, 1.0});
  Body wall{std::make_shared<Cloud>(*make_table(1).mesh), 0, Eigen::Isometry3d::Identity()};
  wall.T_world_body.translation() = Eigen::Vector3d(0.5, 0, 0.7);  // covers x > 0
  const Scan half = scan({far, wall}, sensor, kAtOrigin, 1);
  CHECK(half.views[0].fraction() == Approx(0.5).margin(0.01));
  CHECK(half.views[0].box_visible.width == Approx(half.views[0].box_alone.width / 2.0).margin(2));
  wall.T_world_body.translation().x() = 0;
  CHECK(scan({far, wall}, sensor, kAtOrigin, 1).views[0].visible == 0);
  wall.T_world_body.translation().z() = 1.3;
  CHECK(scan({far, wall}, sensor, kAtOrigin, 1).views[0].fraction() == 1);
}

TEST_CASE("surfaces seen at a grazing angle give no return", "[simulate]") {
  Body plane = make_table(10);  // horizontal, 0.1 m below the sensor's axis
  plane.T_world_body = Eigen::Translation3d(0, 0.1, 2) *
                       Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX());
  const Sensor sensor = find_sensor("laser");
  const Cloud cloud = points_of(scan({plane}, sensor, kAtOrigin, 1).depth, sensor.camera);
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

TEST_CASE("dropped bodies rest on something and do not reach into each other", "[simulate]") {
  const auto mesh = std::make_shared<Cloud>(make_shape("boulder", 1, 0.1));
  std::vector<Body> bodies(6, Body{mesh, 1, Eigen::Isometry3d::Identity()});
  Random random(5);
  drop_bodies(bodies, 0.06, random);  // so close that they must pile up
  double lowest = 1;
  int piled = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Eigen::Matrix3Xd points =
        bodies[i].T_world_body * Eigen::Matrix3Xd(mesh->points.transpose().cast<double>());
    lowest = std::min(lowest, points.row(2).minCoeff());
    piled += points.row(2).minCoeff() > 0.01;
    CHECK(points.row(2).minCoeff() > -1e-9);
    CHECK(bodies[i].T_world_body.translation().head<2>().norm() <= 0.06);
    for (std::size_t k = 0; k < i; ++k) {  // in the frame of an earlier body
      const Eigen::Matrix3Xd in_other = bodies[k].T_world_body.inverse() * points;
      for (Eigen::Index v = 0; v < points.cols(); v += 500)
        CHECK(winding_number(*mesh, in_other.col(v)) == Approx(0).margin(0.01));
    }
  }
  CHECK(std::abs(lowest) < 1e-9);
  CHECK(piled > 0);
}
