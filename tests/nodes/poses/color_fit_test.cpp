// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/color_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/color/srgb.hpp"
#include "nodes/poses/color_turns.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/twins.hpp"
#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::color_fit_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

/// Light at a place of the body: patches of several hues, other ones all around.
Eigen::RowVector3f paint(const Eigen::Vector3f& place) {
  const auto wave = [&](float x, float y, float z) {
    return 0.5F + 0.4F * std::sin(140 * (x * place.x() + y * place.y() + z * place.z()) + x);
  };
  return {wave(1, 0.3F, 0), wave(0, 1, 0.7F), wave(0.4F, 0, 1)};
}

/// A body in a scan, both painted; the light of the scan times `gain`.
struct Painted {
  SoughtBody body{{kBody}};

  explicit Painted(const Eigen::RowVector3f& gain = Eigen::RowVector3f::Ones()) {
    body.params.refine = false;
    Cloud& model = body.model.cloud;
    model.colors.resize(model.points.rows(), 3);
    for (Eigen::Index i = 0; i < model.points.rows(); ++i)
      model.colors.row(i) = paint(model.points.row(i).transpose());
    Cloud scan = body.cloud;
    scan.colors.resize(scan.points.rows(), 3);
    const Eigen::Isometry3f back = kBody.T_scene_model.inverse().cast<float>();
    for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
      scan.colors.row(i) = gain.cwiseProduct(paint(back * scan.points.row(i).transpose()));
    body.scan.look = LookOf(scan);
  }
  ColorFit fit(const Eigen::Isometry3d& T) const {
    return measure_colors(body.sought(), T, 1000).value();
  }
};

}  // namespace

TEST_CASE("colours are like at the right pose, whatever light and camera", "[poses][color]") {
  const Painted plain;
  const ColorFit right = plain.fit(kBody.T_scene_model);
  CHECK(right.likeness > 0.85);
  CHECK(right.patches > 20);
  CHECK(right.tint.norm() < 3);
  CHECK(plain.fit(beside(0, 0.3)).likeness < 0.6 * right.likeness);
  const ColorFit brighter = Painted({2, 2, 2}).fit(kBody.T_scene_model);
  CHECK(brighter.likeness > 0.85);
  CHECK(brighter.tint.norm() < 3);  // exposure is no tint
  const ColorFit cast = Painted({1.3F, 1, 0.7F}).fit(kBody.T_scene_model);
  CHECK(cast.likeness > 0.85);
  CHECK(cast.tint.norm() > 8);
}

TEST_CASE("without colours on both sides nothing is measured", "[poses][color]") {
  Painted setting;
  Model bare = setting.body.model;
  setting.body.model.cloud.colors.resize(0, 3);
  CHECK_FALSE(measure_colors(setting.body.sought(), kBody.T_scene_model, 1000));
  setting.body.model = bare;
  setting.body.scan.look = LookOf(setting.body.cloud);
  CHECK_FALSE(measure_colors(setting.body.sought(), kBody.T_scene_model, 1000));
  Candidate candidate = setting.body.candidate(kBody.T_scene_model);
  turn_by_color(setting.body.sought(), candidate);
  CHECK_FALSE(candidate.colors);
  CHECK(color_lead(candidate.colors, candidate.colors) == 0);
}

TEST_CASE("a scan in grey is compared by lightness alone", "[poses][color]") {
  Painted setting;
  LookOf& look = setting.body.scan.look;
  look.lab.rightCols(2).setZero();
  look.is_colorful = false;
  const ColorFit fit = setting.fit(kBody.T_scene_model);
  CHECK(fit.likeness > 0.85);
  CHECK_FALSE(fit.has_tint);
  ColorClues clues = color_clues_of(fit, Eigen::Vector2d::Zero(), {});
  clues.likeness = 0;
  CHECK(log_odds_of(clues, ColorTerms()) == Approx(0).margin(1e-9));  // no tint says nothing
}

TEST_CASE("clues of colours speak for what is like and against what is not", "[poses][color]") {
  ColorFit fit;
  fit.patches = 40;
  fit.contrast = 25;
  fit.likeness = 0.8;
  fit.has_tint = true;
  const auto clues = [&](double tint, double usual = 0) {
    fit.tint = {tint, 0};
    return color_clues_of(fit, {usual, 0}, {});
  };
  CHECK(clues(0).likeness > 3);
  CHECK(clues(0).tint > 1);
  CHECK(clues(40).tint < -3);
  CHECK(clues(40, 40).tint > 1);  // as the others in this light
  fit.likeness = 0;
  CHECK(clues(0).likeness < -2);
  fit.contrast = 0.5;  // a plain thing is like nothing, and needs not be
  CHECK(std::abs(clues(0).likeness) < 0.1);
}

TEST_CASE("the usual tint is that of what was found", "[poses][color]") {
  UsualTint usual;
  CHECK(usual.tint().isZero());
  ColorFit fit;
  usual.add(std::nullopt);
  usual.add(fit);  // has none
  fit.has_tint = true;
  fit.tint = {8, -4};
  for (int i = 0; i < 3; ++i) usual.add(fit);
  CHECK(usual.tint().isApprox(Eigen::Vector2d(6, -3)));
}

TEST_CASE("of turns after which the shape is the same, colours choose", "[poses][color]") {
  Painted setting;
  Symmetries symmetries;
  symmetries.fixed_point = setting.body.model.center;
  symmetries.axes = {Eigen::Vector3f::UnitZ()};
  setting.body.model.symmetries = setting.body.model.shape_symmetries = symmetries;
  const auto turned = [&](double angle) {
    const Eigen::Vector3d center = setting.body.model.center.cast<double>();
    return setting.body.candidate(kBody.T_scene_model * Eigen::Translation3d(center) *
                                  Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                                  Eigen::Translation3d(-center));
  };
  const auto off = [&](Candidate candidate) {
    turn_by_color(setting.body.sought(), candidate);
    return Eigen::AngleAxisd(candidate.T_scene_model.linear().transpose() *
                             kBody.T_scene_model.linear())
        .angle();
  };
  // The shape is none of an axis: turned a little, enough of it lies on the scan to be compared.
  CHECK(off(turned(0)) < 0.05);
  CHECK(off(turned(0.2)) < 0.08);
  Candidate right = turned(0);
  turn_by_color(setting.body.sought(), right);
  CHECK(symmetries_left(setting.body.sought(), right).axes.empty());
  setting.body.model.cloud.colors.resize(0, 3);
  CHECK(off(turned(0.2)) == Approx(0.2));
  right.colors.reset();
  CHECK(symmetries_left(setting.body.sought(), right).axes.size() == 1);
}

TEST_CASE("of twins that differ nowhere, colours choose", "[poses][color]") {
  Painted setting;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitX()).toRotationMatrix();
  setting.body.model.near_symmetries = {{{motion, {}, {}}}};
  // Beside the right pose, of which the first is the twin, no less probable.
  Candidate wrong = setting.body.candidate(kBody.T_scene_model * motion.inverse());
  const Sought sought = setting.body.sought();
  judge(sought, wrong, {{1000}});
  turn_by_color(sought, wrong);
  wrong.confidence = 1;
  const Candidate best = best_alike(sought, wrong, TakenPlaces(0));
  CHECK(best.T_scene_model.isApprox(kBody.T_scene_model, 1e-9));
  setting.body.model.cloud.colors.resize(0, 3);
  wrong.colors.reset();
  CHECK(best_alike(setting.body.sought(), wrong, TakenPlaces(0))
            .T_scene_model.isApprox(wrong.T_scene_model, 1e-9));
}

TEST_CASE("colours add to the confidence by their weights", "[poses][color]") {
  Painted setting;
  ColorTerms& terms = setting.body.params.terms.color;
  terms.offset = 0;
  terms.weights = {0, 0};  // nothing
  Candidate candidate = setting.body.candidate(kBody.T_scene_model);
  const auto confidence = [&] {
    const Sought sought = setting.body.sought();
    judge(sought, candidate, {{1000}});
    turn_by_color(sought, candidate);
    believe(sought, candidate);
    return candidate.confidence;
  };
  const double by_shape = confidence();
  CHECK(by_shape == probability_of(log_odds_of(candidate.clues, ConfidenceTerms())));
  terms.weights = {1, 0};
  REQUIRE(candidate.color_clues);
  CHECK(confidence() > by_shape);
  terms.offset = -100;  // no more than the doubt allows
  CHECK(confidence() == Approx(probability_of(log_odds_of(candidate.clues, ConfidenceTerms()) +
                                              std::log(terms.doubt))));
}

}  // namespace posevote::color_fit_test
