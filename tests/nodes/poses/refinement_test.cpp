// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/refinement.hpp"

#include <catch2/catch.hpp>

#include "nodes/geometry/outline.hpp"
#include "tests/nodes/geometry/flat_carton.hpp"
#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::refinement_test {

using namespace posevote::poses;
using namespace posevote::test;

TEST_CASE("each step of the refinement brings a pose closer than the one before", "[poses]") {
  const SoughtBody body({kBody});
  poses::Candidate one = body.candidate(beside(0.012, 0.2));
  const double start = distance_to_body(one.T_scene_model);
  poses::take_first_steps(body.sought(), one);
  const double closer = distance_to_body(one.T_scene_model);
  CHECK(closer < 0.6 * start);
  CHECK_FALSE(one.is_refined);
  poses::refine(body.sought(), one);
  const double refined = distance_to_body(one.T_scene_model);
  CHECK(refined < 0.7 * closer);
  CHECK(one.is_refined);
  CHECK(one.quality > 0.8);
  const std::size_t judged = one.fit.facing;
  poses::polish(body.sought(), one);
  CHECK(distance_to_body(one.T_scene_model) < 0.1 * kResolution);
  CHECK(one.fit.facing >= judged);
}

TEST_CASE("a refined pose is judged anew, but stays where it is", "[poses]") {
  SoughtBody body({kBody});
  poses::Candidate one = body.candidate(beside(0));
  poses::refine(body.sought(), one);
  const Eigen::Isometry3d T_before = one.T_scene_model;
  REQUIRE(one.quality > 0.8);
  body.scan.take_out(body.model, kBody.T_scene_model, 3 * kResolution);
  poses::refine(body.sought(), one);
  CHECK(one.T_scene_model.matrix() == T_before.matrix());
  CHECK(one.quality == 0);
}

TEST_CASE("refinement brings a pose closer", "[poses]") {
  const SoughtBody body({kBody});
  const Eigen::Isometry3d start = beside(0.004, 0.05);
  poses::Candidate one = body.candidate(start);
  poses::refine(body.sought(), one);
  CHECK(distance_to_body(one.T_scene_model) < 0.5 * distance_to_body(start));
}

TEST_CASE("without ICP nothing moves", "[poses]") {
  SoughtBody body({kBody});
  body.params.refine = false;
  poses::Candidate one = body.candidate(beside(0.004));
  poses::take_first_steps(body.sought(), one);
  poses::refine(body.sought(), one);
  poses::polish(body.sought(), one);
  CHECK(one.T_scene_model.matrix() == beside(0.004).matrix());
  CHECK(one.quality > 0);
}

TEST_CASE("the ends of a flat face hold a finalist before it is judged", "[poses]") {
  const FlatCarton carton;
  Model model;
  model.cloud = carton.model;
  model.diagonal = 0.145F;
  model.resolution = kStep;
  model.outline = geometry::outline_of(model.cloud, 9 * kStep, 4 * kStep);
  const FeatureSet features;
  const poses::ScanState scan(carton.scan, features, kStep);
  const auto off_by = [&](int ends) {
    poses::SegmentParams params;
    params.terms.edges.ends = ends;
    const poses::Sought sought{model,        scan, poses::instance_params(params, model, kStep),
                               params.terms, 0,    {}};
    poses::Candidate one;
    one.T_scene_model = carton.truth * Eigen::Translation3d(0.006, -0.004, 0.001);
    poses::refine(sought, one);
    return (one.T_scene_model.translation() - carton.truth.translation()).norm();
  };
  CHECK(off_by(0) > 0.004);
  CHECK(off_by(1000) < 0.001);
}

}  // namespace posevote::refinement_test
