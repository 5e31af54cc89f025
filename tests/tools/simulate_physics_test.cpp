// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "nodes/geometry/nearest_index.hpp"
#include "tools/simulate/physics.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote::simulate_physics_test {
namespace {

/// 1 inside a closed mesh, 0 outside: the solid angle that it covers, over 4 pi (van Oosterom,
/// Strackee 1983).
double winding_number(const Mesh& mesh, const Eigen::Vector3d& point) {
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

std::vector<Body> heap(const std::string& shape, std::size_t count, double radius, bool walls,
                       std::uint64_t seed) {
  const auto mesh = std::make_shared<Mesh>(make_shape(shape, 1, 0.12));
  std::vector<Body> bodies(count, Body{mesh, 1, Eigen::Isometry3d::Identity()});
  Random random(seed);
  settle(bodies, radius, walls, random);
  return bodies;
}

Eigen::Matrix3Xd points_of(const Body& body) {
  return body.T_world_body * Eigen::Matrix3Xd(body.mesh->points.transpose().cast<double>());
}

/// How deep points of `body` lie inside of `other`, to a vertex' spacing [m].
double reach_into(const Body& body, const Body& other) {
  const Eigen::Matrix3Xd in_other = other.T_world_body.inverse() * points_of(body);
  const geometry::NearestIndex surface(other.mesh->points, 0.01F);
  double deepest = 0;
  for (Eigen::Index v = 0; v < in_other.cols(); v += 400)
    if (winding_number(*other.mesh, in_other.col(v)) > 0.5)
      if (const auto near = surface.nearest(in_other.col(v).cast<float>(), 0.1F))
        deepest = std::max(deepest, std::sqrt(double{near.squared}));
  return deepest;
}

}  // namespace

TEST_CASE("settled bodies lie on the ground or on each other", "[simulate]") {
  for (const char* shape : {"boulder", "cup"}) {
    INFO(shape);
    const std::vector<Body> bodies = heap(shape, 5, 0.1, true, 5);
    double lowest = 1;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Eigen::Matrix3Xd points = points_of(bodies[i]);
      lowest = std::min(lowest, points.row(2).minCoeff());
      CHECK(points.row(2).minCoeff() > -0.002);
      CHECK(points.topRows(2).cwiseAbs().maxCoeff() < 0.102);  // the walls
      for (std::size_t k = 0; k < bodies.size(); ++k)
        if (k != i) CHECK(reach_into(bodies[i], bodies[k]) < 0.006);
    }
    CHECK(lowest < 0.002);
  }
}

TEST_CASE("what has settled stays, and depends on the seed alone", "[simulate]") {
  const std::vector<Body> first = heap("wrench", 4, 0.05, false, 7);
  const std::vector<Body> again = heap("wrench", 4, 0.05, false, 7);
  const std::vector<Body> other = heap("wrench", 4, 0.05, false, 8);
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].T_world_body.matrix() == again[i].T_world_body.matrix());
    CHECK(first[i].T_world_body.matrix() != other[i].T_world_body.matrix());
  }
  // A lone body comes to lie flat: three corners or more touch the ground.
  const Eigen::Matrix3Xd points = points_of(heap("milk", 1, 0.05, false, 1)[0]);
  CHECK(points.row(2).minCoeff() == Approx(0).margin(0.0015));
  CHECK((points.row(2).array() < points.row(2).minCoeff() + 0.002).count() > 20);
}

}  // namespace posevote::simulate_physics_test
