// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/poses/measure_fit.hpp"
#include "tests/support/box_cloud.hpp"

namespace posevote::bends_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

constexpr float kSpacing = 0.004F, kReach = 1.5F * kSpacing;
const Eigen::Vector3f kSize{0.1F, 0.08F, 0.06F};

Eigen::Isometry3d corner_ahead() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = 0.8;
  T.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 0.8, 0).normalized()));
  return T;
}

/// Whether a box shows the origin two faces within `blurred` [m] of a place on it.
bool is_at_edge(const Eigen::Vector3f& place, const Eigen::Isometry3d& T_scene_model,
                float blurred) {
  int shown = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_beside = kSize[axis] / 2 - std::abs(place[axis]) < blurred;
    const Eigen::Vector3f out = std::copysign(1.0F, place[axis]) * Eigen::Vector3f::Unit(axis);
    shown +=
        is_beside &&
        (T_scene_model.linear().cast<float>() * out).dot(T_scene_model.cast<float>() * place) < 0;
  }
  return shown > 1;
}

/// What of a cloud faces the origin; beside edges its normals turn away from both faces.
Cloud seen(const Cloud& model, const Eigen::Isometry3d& T_scene_model, float blurred) {
  std::vector<Eigen::RowVector3f> points, normals;
  for (Eigen::Index i = 0; i < model.points.rows(); ++i) {
    const auto p = geometry::posed_point(model, i, T_scene_model.cast<float>());
    if (p.normal.dot(p.point) >= 0) continue;
    const bool is_blurred = is_at_edge(model.points.row(i).transpose(), T_scene_model, blurred);
    points.emplace_back(p.point.transpose());
    normals.emplace_back(
        (is_blurred ? p.point.cross(p.normal).normalized() : p.normal).transpose());
  }
  return geometry::cloud_of(points, normals);
}

double agreement(float bend_reach, float blurred, const FitTerms& terms = {}) {
  const Cloud model = box_cloud(kSize, kSpacing);
  const Eigen::Isometry3d T = corner_ahead();
  const Cloud scan = seen(model, T, blurred);
  const geometry::RangeView view(scan, kSpacing);
  const geometry::ScanSurface surface(scan, view.usable(), kSpacing);
  const Outline outline = geometry::outline_of(model, 9 * kSpacing, 4 * kSpacing, bend_reach);
  return shares_of(measure_fit(model, outline, surface, view, T, kSpacing, {}, terms), terms)
      .agreement;
}

}  // namespace

TEST_CASE("normals that are of neither face of a bend do not speak against a pose", "[poses]") {
  const double whole = agreement(kReach, 0);
  CHECK(whole > 0.99);
  CHECK(agreement(0, 0) > 0.99);
  const double blamed = agreement(0, kSpacing), forgiven = agreement(kReach, kSpacing);
  CHECK(blamed < 0.97);
  CHECK(forgiven > whole - 0.3 * (whole - blamed));
  FitTerms none;
  none.bends_forgiven = 0;
  CHECK(agreement(kReach, kSpacing, none) == Approx(blamed));
}

TEST_CASE("what bends all over is forgiven nothing", "[poses]") {
  const Sides half{1, 0, 1, 1, 0.5}, all{1, 0, 1, 2, 1}, none{1, 0, 1, 0, 0};
  const FitTerms terms;
  CHECK(half.against(terms) == Approx(0.5 * (1 - 0.5 * 0.5)));
  CHECK(all.against(terms) == none.against(terms));
  CHECK(Sides{}.against(terms) == 0);
}

}  // namespace posevote::bends_test
