// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/pose_covariance.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

#include "nodes/poses/refinement.hpp"
#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::pose_covariance_test {

using namespace posevote::test;
using geometry::Matrix6d;
using geometry::Vector6d;

namespace {

constexpr double k95 = 12.592;  // chi-square of six degrees of freedom

double squared(const Vector6d& error, const Matrix6d& covariance) {
  return error.dot(covariance.ldlt().solve(error));
}

/// Moves every point of the scan along its normal.
void add_noise(Cloud& scan, float deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, deviation);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    scan.points.row(i) += noise(random) * scan.normals.row(i);
}

/// A square of that many points a side in the plane z = 0 of the model, seen from above.
struct SeenSquare {
  explicit SeenSquare(int side) {
    const auto fill = [side](Cloud& cloud, float z) {
      cloud.points.resize(side * side, 3);
      cloud.normals = PointMatrix::Zero(side * side, 3);
      cloud.normals.col(2).setConstant(-1);
      for (int i = 0; i < side * side; ++i)
        cloud.points.row(i) << kResolution * static_cast<float>(i % side),
            kResolution * static_cast<float>(i / side), z;
    };
    fill(model.cloud, 0);
    model.center = {kResolution * static_cast<float>(side - 1) / 2,
                    kResolution * static_cast<float>(side - 1) / 2, 0};
    model.diagonal = kResolution * static_cast<float>(side) * 1.4F;
    model.resolution = kResolution;
    fill(scan_cloud, 1);
    add_noise(scan_cloud, 2e-4F, 1);
  }
  Model model;
  Cloud scan_cloud;
  FeatureSet features;
};

}  // namespace

TEST_CASE("true errors of a body in noisy scans are as its covariance says", "[poses]") {
  const SoughtBody body({kBody});
  int within = 0, tight = 0;
  constexpr int kScans = 40;
  for (unsigned seed = 0; seed < kScans; ++seed) {
    Cloud noisy = body.cloud;
    add_noise(noisy, 3e-4F, seed);
    const poses::ScanState scan(noisy, body.features, kResolution);
    const poses::Sought sought{body.model, scan, body.sought().params, body.params.terms};
    poses::Candidate one = body.candidate(beside(0.001));
    poses::refine(sought, one);
    poses::polish(sought, one);
    const auto covariance = poses::pose_covariance(sought, one.T_scene_model);
    REQUIRE(covariance);
    const double d2 = squared(
        geometry::log_motion(one.T_scene_model.inverse() * kBody.T_scene_model), *covariance);
    within += d2 <= k95;
    tight += d2 > 0.3;
  }
  CHECK(within >= 0.9 * kScans);
  CHECK(tight >= 0.8 * kScans);  // nor is it far too large
}

TEST_CASE("what a plane does not hold is as uncertain as if nobody had looked", "[poses]") {
  const SeenSquare square(40);
  const poses::Terms terms;
  poses::ScanState scan(square.scan_cloud, square.features, kResolution);
  poses::SegmentParams params;
  const poses::Sought sought{square.model, scan,
                             poses::instance_params(params, square.model, kResolution), terms};
  const auto covariance =
      poses::pose_covariance(sought, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1)));
  REQUIRE(covariance);
  CHECK(Eigen::SelfAdjointEigenSolver<Matrix6d>(*covariance).eigenvalues().minCoeff() > 0);
  CHECK(covariance->isApprox(covariance->transpose()));
  const double shift = terms.covariance.any_shift * double{square.model.diagonal};
  CHECK((*covariance)(5, 5) == Approx(std::pow(terms.covariance.any_turn, 2)).epsilon(0.01));
  // The middle slides; the origin, a corner, does so as well.
  CHECK((*covariance)(0, 0) > shift * shift);
  // What it does hold.
  CHECK(std::sqrt((*covariance)(3, 3)) < 0.01);
  const Eigen::Vector3d middle = square.model.center.cast<double>();
  Vector6d up = Vector6d::Zero();  // how far the middle moves by a twist, along z
  up << Eigen::Vector3d::UnitZ(), middle.cross(Eigen::Vector3d::UnitZ());
  CHECK(std::sqrt(up.dot(*covariance * up)) < 1e-4);
}

TEST_CASE("twice the noise, twice the deviation; the frame of the model does not matter",
          "[poses]") {
  SoughtBody body({kBody});
  const auto covariance_at = [&](float noise) {
    Cloud noisy = body.cloud;
    add_noise(noisy, noise, 7);
    const poses::ScanState scan(noisy, body.features, kResolution);
    const poses::Sought sought{body.model, scan, body.sought().params, body.params.terms};
    return *poses::pose_covariance(sought, kBody.T_scene_model);
  };
  const Matrix6d quiet = covariance_at(3e-4F), loud = covariance_at(6e-4F);
  for (int i = 0; i < 6; ++i) {
    CHECK(std::sqrt(loud(i, i) / quiet(i, i)) > 1.6);
    CHECK(std::sqrt(loud(i, i) / quiet(i, i)) < 2.4);
  }
  // The model's file moved: the same motions of the body are as uncertain.
  const Eigen::Isometry3d T_old_new =
      Eigen::Translation3d(0.5, -0.2, 0.1) * Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 2) / 3);
  const Eigen::Isometry3f T = T_old_new.inverse().cast<float>();
  body.model.cloud.points =
      (body.model.cloud.points * T.linear().transpose()).rowwise() + T.translation().transpose();
  body.model.cloud.normals = body.model.cloud.normals * T.linear().transpose();
  body.model.center = T * body.model.center;
  Cloud noisy = body.cloud;
  add_noise(noisy, 3e-4F, 7);
  const poses::ScanState scan(noisy, body.features, kResolution);
  const poses::Sought sought{body.model, scan, body.sought().params, body.params.terms};
  const auto moved = poses::pose_covariance(sought, kBody.T_scene_model * T_old_new);
  REQUIRE(moved);
  for (const double turn : {0.0, 0.01}) {
    Vector6d error;
    error << 0.001, -0.0005, 0.0007, turn, 0, 0.002;
    const Eigen::Isometry3d motion = geometry::exp_motion(error);
    const double before = squared(error, quiet);
    const double now =
        squared(geometry::log_motion(T_old_new.inverse() * motion * T_old_new), *moved);
    CHECK(now == Approx(before).epsilon(0.1));  // patches are cut otherwise
  }
}

TEST_CASE("a pose that nothing holds or refined has no covariance", "[poses]") {
  SoughtBody body({kBody});
  CHECK_FALSE(poses::pose_covariance(body.sought(), beside(1)));
  body.params.refine = false;
  CHECK_FALSE(poses::pose_covariance(body.sought(), kBody.T_scene_model));
}

}  // namespace posevote::pose_covariance_test
