// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/edge_pairs.hpp"

#include <catch2/catch.hpp>

#include "nodes/geometry/icp.hpp"
#include "nodes/geometry/outline.hpp"
#include "tests/nodes/geometry/flat_carton.hpp"

namespace posevote::edge_pairs_test {

using namespace posevote::test;

namespace {

struct Carton : FlatCarton {
  Eigen::Isometry3d refined(const Eigen::Isometry3d& start, int ends) const {
    const geometry::RangeView view(scan, kStep);
    const geometry::ScanSurface surface(scan, view.usable(), 4 * kStep);
    const Outline outline = geometry::outline_of(model, 9 * kStep, 4 * kStep);
    const auto places =
        geometry::find_face_ends(model, {model.points, kStep}, outline, kStep, ends);
    const geometry::FaceEnds faces(model, places, surface, view, kStep, {.ends = ends});
    return geometry::icp(
        model, surface, start, {40, 2 * kStep, 2 * kStep, 10000}, {},
        [&](const auto& pose, double variance) { return faces.pairs(pose, variance); });
  }
};

double off(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& truth) {
  return (pose.translation() - truth.translation()).norm();
}

}  // namespace

TEST_CASE("a flat face slides under ICP, and its ends hold it", "[segment]") {
  const Carton carton;
  Eigen::Isometry3d start = carton.truth;
  start.translation() += Eigen::Vector3d(0.003, -0.002, 0.001);
  start.rotate(Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitZ()));
  CHECK(off(carton.refined(start, 0), carton.truth) > 0.003);
  const Eigen::Isometry3d held = carton.refined(start, 300);
  CHECK(off(held, carton.truth) < 0.0005);
  CHECK(Eigen::AngleAxisd(held.linear()).angle() < 0.01);
}

TEST_CASE("ends hold a face that lies ten spacings off, too", "[segment]") {
  const Carton carton;
  Eigen::Isometry3d start = carton.truth;
  start.translation() += Eigen::Vector3d(0.016, -0.012, 0.001);
  CHECK(off(carton.refined(start, 300), carton.truth) < 0.0005);
}

TEST_CASE("at most so many ends of a face are found, evenly strewn", "[segment]") {
  const Carton carton;
  const Outline outline = geometry::outline_of(carton.model, 9 * kStep, 4 * kStep);
  const auto ends =
      geometry::find_face_ends(carton.model, {carton.model.points, kStep}, outline, kStep, 80);
  CHECK(ends.size() > 40);
  CHECK(ends.size() <= 80);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const FaceEnd& end : ends) {
    const Eigen::Vector3f beyond =
        (end.place.cwiseAbs() - Eigen::Vector3f(0.06F, 0.04F, 0)).cwiseMax(0);
    CHECK(beyond.norm() < 2 * kStep);  // at the rim
    sum += end.direction;
  }
  CHECK(sum.norm() < 0.2F * static_cast<float>(ends.size()));  // on all sides
  CHECK(geometry::find_face_ends(carton.model, {carton.model.points, kStep}, outline, kStep, 0)
            .empty());
}

TEST_CASE("what ends behind something nearer does not hold a face", "[segment]") {
  Carton carton;
  // A board covers the right half: the face seems to end in its middle.
  Cloud half;
  add_plane(half, {-0.049F, -0.047F}, {0.011F, 0.033F}, 0.8F);
  add_plane(half, {0.006F, -0.1F}, {0.1F, 0.1F}, 0.6F);
  add_plane(half, {-0.2F, -0.2F}, {0.2F, 0.2F}, 0.8F + kFar);
  carton.scan = half;
  Eigen::Isometry3d start = carton.truth;
  start.translation().x() += 0.003;
  CHECK(off(carton.refined(start, 300), carton.truth) < 0.0006);
}

}  // namespace posevote::edge_pairs_test
