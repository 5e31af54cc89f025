// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>

#include "nodes/data/detections.hpp"
#include "nodes/data/hypotheses.hpp"
#include "nodes/poses/measure_fit.hpp"
#include "tests/support/bumpy_scene.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::segment_hypotheses_test {

using namespace posevote::test;

namespace {

const Placed kLeft{1, pose(-0.08, 0.01, 0.8, 0.7)};
const Placed kRight{1, pose(0.09, -0.02, 0.75, 2.5)};

Hypothesis beside(const Placed& body, double metres, double support) {
  Eigen::Isometry3d T = body.T_scene_model;
  T.translation().x() += metres;
  return hypothesis_of(T, bumpy_model(1)->center, support);
}

using Values = std::map<std::string, std::string>;

/// Where nothing else lies.
std::vector<Detection> segmented(const Hypotheses& proposed, const Cloud& scan, Values values) {
  values["kinds"] = "1";
  PerObject<Hypotheses> objects;
  objects.slots = {std::make_shared<Hypotheses>(proposed)};
  return run_node<Detections>("segment_hypotheses", values, objects, features_of(scan), scan,
                              Scale{kResolution})
      .items;
}

std::vector<Detection> segmented(const std::vector<Hypothesis>& hypotheses, const Values& values) {
  return segmented({bumpy_model(1), hypotheses}, scan_of({kLeft, kRight}), values);
}

double shift(const Detection& found, const Placed& body) {
  return (found.T_scene_model.translation() - body.T_scene_model.translation()).norm();
}

}  // namespace

TEST_CASE("segment_hypotheses judges by the scan, not by support", "[segment]") {
  const auto found = segmented({beside(kLeft, 0.4, 90), beside(kRight, 0.004, 20)}, {});
  REQUIRE(found.size() == 1);
  CHECK(shift(found[0], kRight) < 0.002);  // after ICP
  CHECK(found[0].density == 20);
  CHECK(found[0].runner_up_density == 90);
  CHECK(found[0].score > 0.5);
}

TEST_CASE("segment_hypotheses finds every instance once", "[segment]") {
  const auto found = segmented({beside(kLeft, 0, 30), beside(kLeft, 0.005, 29),
                                beside(kRight, 0, 8), beside(kRight, 0.3, 7)},
                               {{"max_instances", "5"}});
  REQUIRE(found.size() == 2);
  CHECK(std::min(shift(found[0], kLeft), shift(found[1], kLeft)) < 0.002);
  CHECK(std::min(shift(found[0], kRight), shift(found[1], kRight)) < 0.002);
}

TEST_CASE("a pose that is proposed roughly is told from wrong ones that fit better as they come",
          "[segment]") {
  Hypotheses proposed{bumpy_model(1), {}};
  std::vector<Placed> bodies{kLeft};
  for (const double x : {0.1, 0.25})
    for (const double y : {-0.2, 0.0, 0.2}) {
      bodies.push_back({1, pose(x, y, 0.8, 10 * x + y)});
      proposed.items.push_back(beside(bodies.back(), 0, 10));
    }
  Cloud scan = scan_of(bodies);
  // Of the others a half is missing.
  const auto is_missing = [&](const Eigen::RowVector3f& point) {
    return std::any_of(bodies.begin() + 1, bodies.end(), [&](const Placed& body) {
      const Eigen::Vector3f t = body.T_scene_model.translation().cast<float>();
      return (point.transpose() - t).norm() < 0.1F && point.x() > t.x();
    });
  };
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    if (is_missing(scan.points.row(i))) scan.points.row(i).setConstant(-5);
  Eigen::Isometry3d rough = kLeft.T_scene_model;
  rough.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -1, 0.5).normalized()));
  rough.translation().x() += 0.01;
  proposed.items.push_back(beside({1, rough}, 0, 10));
  const auto found = segmented(
      proposed, scan, {{"max_instances", "1"}, {"min_score", "0.05"}, {"min_confidence", "0"}});
  REQUIRE(found.size() == 1);
  CHECK(shift(found[0], kLeft) < 0.002);
  CHECK(found[0].score > 0.5);
}

TEST_CASE("a look-alike that lies off by more than the others is told by them", "[segment]") {
  Cloud scan = scan_of({kLeft, kRight});
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {  // the right body has broad waves of 4 mm
    const Eigen::RowVector3f p = scan.points.row(i);
    const float wave = 0.004F * std::sin(100 * p.x()) * std::sin(100 * p.y());
    if (p.x() > 0 && p.z() < 1) scan.points.row(i) += wave * scan.normals.row(i);
  }
  // The exact one goes first, and is what the other is judged by.
  const Hypothesis left = beside(kLeft, 0, 30), right = beside(kRight, 0, 20);
  const auto found = [&](const std::vector<Hypothesis>& hypotheses, const char* max_residual) {
    return segmented({bumpy_model(1), hypotheses}, scan,
                     {{"max_instances", "2"},
                      {"min_score", "0.65"},
                      {"min_confidence", "0"},
                      {"max_residual", max_residual}});
  };
  const auto both = found({left, right}, "0");
  REQUIRE(both.size() == 2);
  INFO("rmse " << both[0].rmse << ", " << both[1].rmse);
  CHECK(shift(both[1], kRight) < 0.002);
  const auto told = found({left, right}, "1");
  REQUIRE(told.size() == 1);
  CHECK(shift(told[0], kLeft) < 0.002);
  CHECK(found({right}, "1").size() == 1);  // of itself it says nothing
}

TEST_CASE("poses that look nearly like a proposed one are tried, too", "[segment]") {
  const Cloud scan = scan_of({kLeft});
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() =
      Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  auto model = std::make_shared<Model>(*bumpy_model(1));
  const auto found_with = [&](const NearSymmetries& near_symmetries) {
    model->near_symmetries = near_symmetries;
    return segmented({model, {beside({1, kLeft.T_scene_model * turned.inverse()}, 0, 9)}}, scan,
                     {});
  };
  const auto alone = found_with({});
  CHECK((alone.empty() || shift(alone[0], kLeft) > 0.002 || alone[0].score < 0.8));
  const auto found = found_with({{{turned, {}, {}}}});
  REQUIRE(found.size() == 1);
  CHECK(shift(found[0], kLeft) < 0.002);
  CHECK(found[0].T_scene_model.linear().isApprox(kLeft.T_scene_model.linear(), 0.02));
  CHECK(found[0].density == 9);  // of the mode that it came from
}

TEST_CASE("of poses that look alike, confidences and points where they differ decide",
          "[segment]") {
  const Cloud scan = scan_of({kLeft});
  const geometry::RangeView view(scan, kResolution);
  const geometry::ScanSurface surface(scan, view.usable(), 2 * kResolution);
  auto model = std::make_shared<Model>(*bumpy_model(1));
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Isometry3d wrong = kLeft.T_scene_model * turned.inverse();
  std::vector<std::uint32_t> for_wrong, for_right;
  for (std::uint32_t i = 0; i < model->cloud.points.rows(); ++i) {
    const auto says = [&](const Eigen::Isometry3d& T) {
      return poses::weigh_points(model->cloud, {i}, surface, view, T, 2 * kResolution).balance;
    };
    if (says(wrong) > 0) for_wrong.push_back(i);
    if (says(kLeft.T_scene_model) > 0) for_right.push_back(i);
  }
  REQUIRE(for_wrong.size() > 100);
  const auto is_found = [&](const NearSymmetry& near_symmetry, const char* lead_odds = "1") {
    model->near_symmetries = {{near_symmetry}};
    const auto found =
        segmented({model, {beside({1, wrong}, 0, 9)}}, scan,
                  {{"refine", "false"}, {"lead_odds", lead_odds}, {"err_alike", "1e18"}});
    return found.size() == 1 &&
           found[0].T_scene_model.linear().isApprox(kLeft.T_scene_model.linear(), 0.02);
  };
  CHECK(is_found({turned, {}, {}}));
  CHECK(is_found({turned, for_right, {}}));
  CHECK(is_found({turned, {}, for_wrong}));  // its confidence is much higher
  CHECK_FALSE(is_found({turned, {}, for_wrong}, "100"));
}

TEST_CASE("terms are parameters for experts", "[segment]") {
  const auto score = [](const Values& terms) {
    const auto found = segmented({beside(kLeft, 0, 20)}, terms);
    return found.empty() ? 0 : found[0].score;
  };
  const double usual = score({});
  REQUIRE(usual > 0.5);
  CHECK(score({{"convincing", "0.1"}}) == usual);
  CHECK(score({{"convincing", "0.3"}}) < 0.95 * usual);      // of how a pose is judged,
  CHECK(score({{"least_normal_cosine", "0.99"}}) < usual);   // of the scan's surface,
  CHECK(score({{"icp_fewest_pairs", "1000000"}}) != usual);  // of ICP
}

TEST_CASE("segment_hypotheses of nothing is nothing", "[segment]") {
  CHECK(segmented({}, {}).empty());
}

}  // namespace posevote::segment_hypotheses_test
