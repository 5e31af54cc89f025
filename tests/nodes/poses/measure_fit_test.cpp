// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/measure_fit.hpp"

#include <catch2/catch.hpp>

#include "nodes/geometry/select_rows.hpp"
#include "tests/support/box_cloud.hpp"
#include "tests/support/bumpy_scene.hpp"

namespace posevote::measure_fit_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

constexpr float kTolerance = 2 * kResolution;
constexpr float kReach = 2.5F * kTolerance, kGapReach = 2 * kTolerance;

poses::Fit fit_of(const Cloud& model, const Cloud& scan, const Eigen::Isometry3d& T_scene_model) {
  const geometry::RangeView view(scan, kResolution);
  const geometry::ScanSurface surface(scan, view.usable(), kTolerance);
  const Outline outline = geometry::outline_of(model, kReach, kGapReach);
  return poses::measure_fit(model, outline, surface, view, T_scene_model, kTolerance, {0, true});
}

const Placed kBody{1, pose(0, 0.02, 0.8, 0.7)};

}  // namespace

TEST_CASE("at the true pose nearly all that faces the sensor is supported", "[poses]") {
  const poses::Fit fit = fit_of(bumpy_model(1)->cloud, scan_of({kBody}), kBody.T_scene_model);
  CHECK(fit.facing > 1000);
  CHECK(fit.inlier_fraction > 0.9);
  CHECK(fit.contradicted == 0);
  CHECK(fit.rmse < 0.1 * kResolution);
  CHECK(poses::fit_quality(fit) > 0.9);
}

TEST_CASE("named points weigh what they say of a pose", "[poses]") {
  const Cloud model = bumpy_model(1)->cloud;
  const Cloud scan = scan_of({kBody});
  const geometry::RangeView view(scan, kResolution);
  const geometry::ScanSurface surface(scan, view.usable(), kTolerance);
  const auto weigh = [&](const Eigen::Isometry3d& T, const std::vector<std::uint32_t>& points) {
    return poses::weigh_points(model, points, surface, view, T, kTolerance);
  };
  for (const Eigen::Isometry3d& T : {kBody.T_scene_model, pose(0.03, 0, 0.8, 0)}) {
    std::vector<std::uint32_t> plain, grazing;  // 70 deg
    for (Eigen::Index i = 0; i < model.points.rows(); ++i) {
      const auto p = geometry::posed_point(model, i, T.cast<float>());
      (p.normal.dot(-p.point.normalized()) < 0.35F ? grazing : plain)
          .push_back(static_cast<std::uint32_t>(i));
    }
    const poses::Fit fit = fit_of(geometry::select_rows(model, plain), scan, T);
    const poses::Evidence evidence = weigh(T, plain);
    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    CHECK(evidence.sides == fit.facing - fit.hidden);
    CHECK(evidence.balance == count(fit.supported) - count(fit.contradicted) -
                                  0.5 * count(fit.mismatched + fit.unseen));
    // What need not be measured speaks for a pose, not against it.
    const poses::Evidence sides_seen = weigh(T, grazing);
    CHECK(sides_seen.balance == count(sides_seen.sides));
    CHECK(sides_seen.sides < grazing.size());
  }
  CHECK(weigh(kBody.T_scene_model, {}).sides == 0);
}

TEST_CASE("a side counts as large as it looks, or not at all where none need be measured",
          "[poses]") {
  constexpr float kEdge = 0.1F, kSpacing = 0.002F, kRange = 0.8F;  // [m]
  const Cloud box = box_cloud(Eigen::Vector3f::Constant(kEdge), kSpacing);
  // Of a box so far beside the sensor the front was measured, and something else, not its side.
  const auto fit_beside = [&](float x) {
    std::vector<Eigen::RowVector3f> points, normals;
    for (const Eigen::Vector3f& center :
         {Eigen::Vector3f(x, 0, kRange - 0.5F * kEdge), Eigen::Vector3f(-0.1F, 0, kRange)})
      add_rectangle(points, normals, center, {0, kEdge, 0}, {kEdge, 0, 0}, kSpacing);
    const Eigen::Isometry3d T(Eigen::Translation3d(double(x), 0, double(kRange)));
    return fit_of(box, geometry::cloud_of(points, normals), T);
  };
  const poses::Fit grazing = fit_beside(0.15F), plain = fit_beside(0.5F);
  for (const poses::Fit& fit : {grazing, plain}) CHECK(fit.unseen > fit.facing / 3);
  CHECK(grazing.apparent.supported > 0.95 * double(grazing.supported));
  CHECK(grazing.apparent.mismatched < 0.02 * double(grazing.unseen));  // at its rim
  CHECK(plain.apparent.supported == Approx(0.83 * double(plain.supported)).epsilon(0.05));
  CHECK(plain.apparent.mismatched == Approx(0.5 * double(plain.unseen)).epsilon(0.1));
}

TEST_CASE("a body before what was measured is contradicted", "[poses]") {
  const Eigen::Isometry3d before = pose(0, 0, 1.0, 0.7);
  const poses::Fit fit = fit_of(bumpy_model(1)->cloud, scan_of({}), before);
  CHECK(fit.contradicted == fit.facing);
  CHECK(poses::fit_quality(fit) == 0);
}

TEST_CASE("a body behind what was measured is hidden", "[poses]") {
  const poses::Fit fit = fit_of(bumpy_model(1)->cloud, scan_of({}), pose(0, 0, 1.5, 0.7));
  CHECK(fit.hidden == fit.facing);
  CHECK(fit.outside == 0);
  CHECK(poses::fit_quality(fit) == 0);
}

TEST_CASE("a body where nothing was measured is unseen", "[poses]") {
  const poses::Fit fit =
      fit_of(bumpy_model(1)->cloud, scan_of({kBody}, false), pose(0.5, 0, 0.8, 0));
  CHECK(fit.unseen == fit.facing);
  CHECK(poses::fit_quality(fit) == 0);
}

TEST_CASE("beside the image nobody looked, if it is known where the image ends", "[poses]") {
  Cloud scan = scan_of({kBody}, false);
  const Eigen::Isometry3d beside = pose(0.5, 0, 0.8, 0.7);
  const poses::Fit unknown = fit_of(bumpy_model(1)->cloud, scan, beside);
  CHECK(unknown.unseen == unknown.facing);
  scan.view.image = Eigen::AlignedBox2f(Eigen::Vector2f(-0.3F, -0.3F), Eigen::Vector2f(0.3F, 0.3F));
  const poses::Fit known = fit_of(bumpy_model(1)->cloud, scan, beside);
  CHECK(known.facing == unknown.facing);
  CHECK(known.hidden == known.facing);
  CHECK(known.outside == known.facing);
}

TEST_CASE("a body cut off by the image's border agrees with the scan", "[poses]") {
  const Cloud whole = scan_of({kBody}, false);
  std::vector<Eigen::Index> left;
  for (Eigen::Index i = 0; i < whole.points.rows(); ++i)
    if (whole.points(i, 0) < 0) left.push_back(i);
  Cloud scan;
  scan.points = whole.points(left, Eigen::all);
  scan.normals = whole.normals(left, Eigen::all);
  const double unknown =
      poses::fit_quality(fit_of(bumpy_model(1)->cloud, scan, kBody.T_scene_model));
  scan.view.image = Eigen::AlignedBox2f(Eigen::Vector2f(-0.3F, -0.3F), Eigen::Vector2f(0, 0.3F));
  const double known = poses::fit_quality(fit_of(bumpy_model(1)->cloud, scan, kBody.T_scene_model));
  CHECK(unknown < 0.75);
  CHECK(known > 0.85);
}

TEST_CASE("a surface that looks elsewhere supports nothing", "[poses]") {
  Cloud scan = scan_of({kBody});
  for (Eigen::Index i = 0; i < scan.normals.rows(); ++i)
    scan.normals.row(i) = Eigen::RowVector3f(1, 0, -0.2F).normalized();
  const poses::Fit fit = fit_of(bumpy_model(1)->cloud, scan, kBody.T_scene_model);
  CHECK(fit.mismatched > fit.supported);
}

TEST_CASE("hidden parts cost a true pose little, a wrong pose scores far less", "[poses]") {
  const Placed before{3, pose(0.03, 0.03, 0.6, 0.2)};
  const Cloud scan = scan_of({kBody, before});
  const Cloud model = bumpy_model(1)->cloud;
  const poses::Fit fit = fit_of(model, scan, kBody.T_scene_model);
  CHECK(fit.inlier_fraction < 0.7);
  const double score = poses::fit_quality(fit);
  CHECK(score > 0.1);
  for (int turn = 1; turn < 8; ++turn) {
    const Eigen::Isometry3d wrong = kBody.T_scene_model * pose(0, 0, 0, 0.785 * turn);
    CHECK(poses::fit_quality(fit_of(model, scan, wrong)) < 0.5 * score);
  }
}

TEST_CASE("a flat patch is weak evidence, however well it fits", "[poses]") {
  const Cloud patch = test::detail::wall(1.0F, 0.05F), scan = test::detail::wall(1.0F, 0.3F);
  const poses::Fit fit = fit_of(patch, scan, Eigen::Isometry3d::Identity());
  CHECK(fit.inlier_fraction == 1);
  CHECK(fit.relief < 1e-6);
  CHECK(poses::fit_quality(fit) < 0.05);
}

TEST_CASE("a plate's rim has ends, its middle none, a closed body hardly any", "[poses]") {
  const float half = 0.1F;
  const Cloud plate = test::detail::wall(0, half);
  const Outline outline = geometry::outline_of(plate, kReach, kGapReach);
  for (Eigen::Index i = 0; i < plate.points.rows(); ++i) {
    const float inside = half - plate.points.row(i).head<2>().cwiseAbs().maxCoeff();
    int ends = 0;
    geometry::for_each_end(plate, outline, i, [&](const Eigen::Vector3f& place) {
      ++ends;
      CHECK((place - Eigen::Vector3f(plate.points.row(i))).norm() == Approx(kReach).epsilon(1e-4));
      CHECK(place.head<2>().cwiseAbs().maxCoeff() > half);
    });
    if (inside > kReach) CHECK(ends == 0);
    if (inside < 0.1F * kReach) CHECK(ends >= 2);
  }
  const Cloud body = bumpy_model(1)->cloud;
  const Outline body_outline = geometry::outline_of(body, kReach, kGapReach);
  int ends = 0;
  for (Eigen::Index i = 0; i < body.points.rows(); ++i)
    geometry::for_each_end(body, body_outline, i, [&](const Eigen::Vector3f&) { ++ends; });
  CHECK(ends < geometry::kOutlineDirections * body.points.rows() / 50);
}

TEST_CASE("a flat side is evidence where its outline is the scan's", "[poses]") {
  const Cloud side = test::detail::wall(1.0F, 0.05F);
  Cloud scan = side;
  test::detail::append(scan, test::detail::wall(1.3F, 0.3F), Eigen::Isometry3d::Identity());
  const poses::Fit fit = fit_of(side, scan, Eigen::Isometry3d::Identity());
  CHECK(fit.relief < 1e-6);
  CHECK(fit.ends > 100);
  CHECK(fit.overhang == 0);
  const double score = poses::fit_quality(fit);
  CHECK(score > 0.8);
  // A narrower side fits inside of it as well, but the scan goes on on both sides.
  Cloud narrow = side;
  narrow.points.col(0) *= 0.6F;
  const poses::Fit inside = fit_of(narrow, scan, Eigen::Isometry3d::Identity());
  CHECK(inside.inlier_fraction == 1);
  CHECK(10 * inside.overhang > 3 * inside.ends);
  CHECK(poses::fit_quality(inside) < 0.7 * score);
}

TEST_CASE("a plate with a hole is not at home on one without", "[poses]") {
  const Cloud solid = test::detail::wall(1.0F, 0.05F);
  Cloud holed = solid;
  std::vector<Eigen::Index> left;
  for (Eigen::Index i = 0; i < solid.points.rows(); ++i)
    if (solid.points.row(i).head<2>().norm() > 1.5F * kTolerance) left.push_back(i);
  holed.points = solid.points(left, Eigen::all).eval();
  holed.normals = solid.normals(left, Eigen::all).eval();
  const auto scan_with = [](const Cloud& plate) {
    Cloud scan = plate;
    test::detail::append(scan, test::detail::wall(1.3F, 0.3F), Eigen::Isometry3d::Identity());
    return scan;
  };
  const auto filled = [&](const Cloud& scan) {
    const poses::Fit fit = fit_of(holed, scan, Eigen::Isometry3d::Identity());
    CHECK(fit.gaps > fit.ends);  // at the hole there are no ends
    return static_cast<double>(fit.filled_holes) / static_cast<double>(fit.holes);
  };
  CHECK(filled(scan_with(holed)) < 0.01);
  CHECK(filled(scan_with(solid)) > 0.9);
}

TEST_CASE("the ground close under a plate is not the plate", "[poses]") {
  const Cloud plate = test::detail::wall(1.0F, 0.05F);
  const auto overhang_on = [&plate](float below) {
    Cloud scan = plate;
    test::detail::append(scan, test::detail::wall(1.0F + below, 0.3F),
                         Eigen::Isometry3d::Identity());
    const poses::Fit fit = fit_of(plate, scan, Eigen::Isometry3d::Identity());
    return static_cast<double>(fit.overhang) / static_cast<double>(fit.ends);
  };
  CHECK(overhang_on(0.7F * kTolerance) == 0);
  CHECK(overhang_on(0.05F * kTolerance) > 0.9);
}

TEST_CASE("the ground on which a body stands is not its overhang", "[poses]") {
  // A foot as thin as nothing, and something over or under it.
  const auto overhang_with = [](float under) {
    Cloud body = test::detail::wall(0, 0.05F);
    if (under != 0)
      test::detail::append(body, test::detail::wall(under, 0.02F), Eigen::Isometry3d::Identity());
    const Eigen::Isometry3d T(Eigen::Translation3d(0, 0, 1));
    Cloud scan = test::detail::wall(1, 0.3F);
    test::detail::append(scan, body, T);
    const poses::Fit fit = fit_of(body, scan, T);
    CHECK(fit.ends > 100);
    return static_cast<double>(fit.overhang) / static_cast<double>(fit.ends);
  };
  CHECK(overhang_with(-0.05F) < 0.02);
  CHECK(overhang_with(0.05F) > 0.6);
  CHECK(overhang_with(0) > 0.9);
}

TEST_CASE("a sample of the model gives nearly the same fit", "[poses]") {
  const Cloud scan = scan_of({kBody}), model = bumpy_model(1)->cloud;
  const geometry::RangeView view(scan, kResolution);
  const geometry::ScanSurface surface(scan, view.usable(), kTolerance);
  const Outline outline = geometry::outline_of(model, kReach, kGapReach);
  const poses::Fit all =
      poses::measure_fit(model, outline, surface, view, kBody.T_scene_model, kTolerance);
  const poses::Fit some =
      poses::measure_fit(model, outline, surface, view, kBody.T_scene_model, kTolerance, {800});
  CHECK(some.facing < all.facing / 4);
  CHECK(poses::fit_quality(some) == Approx(poses::fit_quality(all)).margin(0.05));
}

TEST_CASE("a cloud that is no view is judged without facing or free space", "[poses]") {
  const Cloud model = bumpy_model(1)->cloud;
  const poses::Fit fit = fit_of(model, model, Eigen::Isometry3d::Identity());
  CHECK(fit.facing == static_cast<std::size_t>(model.points.rows()));
  CHECK(fit.supported == fit.facing);
  CHECK(fit.rmse == Approx(0).margin(1e-7));
}

TEST_CASE("nothing to judge scores 0", "[poses]") {
  Cloud empty;
  empty.points.resize(0, 3);
  empty.normals.resize(0, 3);
  CHECK(poses::fit_quality(fit_of(empty, scan_of({kBody}), kBody.T_scene_model)) == 0);
  CHECK(poses::fit_quality(fit_of(bumpy_model(1)->cloud, empty, kBody.T_scene_model)) == 0);
}

}  // namespace posevote::measure_fit_test
