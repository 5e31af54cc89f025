// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/confidence.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/poses/score.hpp"
#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::confidence_test {

using namespace posevote::test;

namespace {

/// Of a pose for which all speaks.
poses::Fit good_fit() {
  poses::Fit fit;
  fit.facing = fit.supported = 1000;
  fit.apparent.supported = 800;
  fit.ends = 400, fit.gaps = 500;
  fit.inlier_fraction = 1;
  fit.relief = 0.5;
  return fit;
}

double believed(const poses::Fit& fit, const poses::Backing& backing = {1, 0.5, 2}) {
  return poses::probability_of(
      poses::log_odds_of(poses::clues_of(fit, backing), poses::ConfidenceTerms()));
}

}  // namespace

TEST_CASE("each clue moves the confidence its way", "[poses]") {
  const double usual = believed(good_fit());
  CHECK(usual > 0.98);
  poses::Fit fit = good_fit();
  fit.apparent.contradicted = 640;
  CHECK(believed(fit) < usual);
  fit = good_fit();
  fit.overhang = 80;
  CHECK(believed(fit) < usual);
  fit = good_fit();
  fit.holes = 40, fit.filled_holes = 20;
  CHECK(believed(fit) == Approx(usual));
  fit.filled_holes = 36;
  CHECK(believed(fit) < usual);
  fit.filled_holes = 4;
  CHECK(believed(fit) > usual);
  fit = good_fit();
  fit.ends = 0;
  CHECK(believed(fit) < usual);
  fit = good_fit();
  fit.supported = fit.facing = 40, fit.ends = 16;
  CHECK(believed(fit) < usual);
  fit = good_fit();
  fit.supported = 600, fit.hidden = 400;
  const poses::Backing behind{1, 0.5, 0.8}, ahead{1, 0.5, 4};
  const double hidden = believed(fit, behind), hidden_ahead = believed(fit, ahead);
  fit.outside = 400;
  CHECK(believed(fit, behind) < hidden);
  CHECK(believed(fit, ahead) == hidden_ahead);
  CHECK(believed(good_fit(), {0.6, 0.5, 2}) < usual);
  CHECK(believed(good_fit(), {1, 0.01, 2}) < usual);
  CHECK(believed(good_fit(), {1, 0.5, 0.5}) < usual);
  CHECK(believed(good_fit(), {1, 0.5, 2, 0.4}) < usual);
}

TEST_CASE("a sample of the points makes the same clues", "[poses]") {
  poses::Fit sample = good_fit();
  sample.facing = sample.supported = 100, sample.ends = 40, sample.gaps = 50;
  sample.holes = 8, sample.filled_holes = 3;
  sample.stands_for = 10;
  const poses::Backing backing{1, 0.5, 2};
  poses::Fit whole = good_fit();
  whole.holes = 80, whole.filled_holes = 30;
  const Clues all = poses::clues_of(whole, backing);
  const Clues few = poses::clues_of(sample, backing);
  for (std::size_t i = 0; i < kClueCount; ++i) CHECK(few[i] == Approx(all[i]));
}

TEST_CASE("the true pose is believed, one beside it less, one elsewhere not", "[poses]") {
  const SoughtBody body({kBody});
  const auto confidence = [&](const Eigen::Isometry3d& T_scene_model) {
    poses::Candidate one = body.candidate(T_scene_model);
    one.is_refined = true;
    poses::judge(body.sought(), one, poses::kAllPoints);
    poses::believe(body.sought(), one);
    return one.confidence;
  };
  CHECK(confidence(beside(0)) > 0.8);
  CHECK(confidence(beside(0.006, 0.3)) < confidence(beside(0)));
  CHECK(confidence(beside(0.5)) == 0);
}

TEST_CASE("of the fewer kinds that are known, the more probably a pose is a stranger's",
          "[poses]") {
  poses::Candidate instance;
  instance.fit = good_fit();
  instance.quality = 1;
  instance.clues = poses::clues_of(instance.fit, {1, 0.5, 2});
  const poses::Terms terms;
  const double unasked = poses::confidence_of(instance, terms);
  const auto among = [&](std::size_t kinds, std::size_t found) {
    poses::Candidate one = instance;
    poses::doubt_as_stranger({kinds, std::vector<poses::Companion>(found)}, terms, one);
    return one.confidence;
  };
  CHECK(among(0, 0) == unasked);
  CHECK(among(20, 0) == unasked);
  CHECK(among(100, 3) == unasked);
  CHECK(poses::log_odds_of(among(1, 0)) ==
        Approx(poses::log_odds_of(unasked) - std::log(20)).margin(1e-6));
  CHECK(among(1, 0) < among(8, 0));
  // Where one was found there are more.
  CHECK(among(1, 0) < among(1, 3));
  CHECK(among(1, 10) == unasked);
  poses::Candidate one = instance;
  poses::doubt_as_stranger({1, {}}, terms, one);
  CHECK(one.clues[kStrangers] == Approx(-std::log(20)));
  poses::doubt_as_stranger({}, terms, one);
  CHECK(one.confidence == unasked);
  // What is nothing is no less.
  one.quality = one.confidence = 0;
  poses::doubt_as_stranger({1, {}}, terms, one);
  CHECK(one.confidence == 0);
}

}  // namespace posevote::confidence_test
