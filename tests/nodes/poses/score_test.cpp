// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/score.hpp"

#include <catch2/catch.hpp>

#include "nodes/poses/confidence.hpp"
#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::score_test {

using namespace posevote::poses;
using namespace posevote::test;

TEST_CASE("a pose off by some degrees grades lower, one elsewhere has no quality", "[poses]") {
  const SoughtBody body({kBody});
  poses::Candidate right = body.candidate(beside(0)), turned = body.candidate(beside(0, 0.5));
  poses::Candidate elsewhere = body.candidate(beside(0.4));
  for (poses::Candidate* one : {&right, &turned, &elsewhere})
    poses::judge(body.sought(), *one, {1000});
  CHECK(right.quality > 0.8);
  CHECK(turned.quality < 0.8 * right.quality);
  CHECK(turned.quality > 0);
  CHECK(elsewhere.quality == 0);
}

TEST_CASE("a pose is judged by about as many points as are asked for", "[poses]") {
  const SoughtBody body({kBody});
  const auto facing = [&](Eigen::Index points) {
    return static_cast<double>(poses::measure(body.sought(), beside(0), {points}).facing);
  };
  const auto all = static_cast<double>(body.model.cloud.points.rows());
  CHECK(facing(0) == Approx(0.45 * all).epsilon(0.05));
  CHECK(facing(300) == Approx(0.45 * 300).epsilon(0.2));
}

TEST_CASE("a glance reaches farther than a look, and each is remembered for itself", "[poses]") {
  const SoughtBody body({kBody});
  const double off = 1.5 * static_cast<double>(body.sought().params.tolerance);
  Eigen::Isometry3d T = beside(0);
  T.pretranslate(Eigen::Vector3d(0, 0, off));  // along the rays
  for (int again = 0; again < 2; ++again) {
    const Fit look = poses::measure(body.sought(), T, {{300}});
    const Fit glance = poses::measure(body.sought(), T, {{300}, 2});
    CHECK(glance.facing == look.facing);
    CHECK(glance.supported > 2 * look.supported);
  }
}

TEST_CASE("less support lowers the rank, not the quality", "[poses]") {
  SoughtBody body({kBody});
  body.params.terms.score.trust_in_clues = 0;
  poses::Candidate much = body.candidate(beside(0), 100), little = body.candidate(beside(0), 1);
  poses::Sought sought = body.sought();
  sought.most_support = 100;
  for (poses::Candidate* one : {&much, &little}) poses::judge(sought, *one, {});
  CHECK(much.quality == little.quality);
  CHECK(much.rank == much.quality);
  CHECK(little.rank == Approx(little.quality / 1.585).epsilon(0.001));
  body.params.terms.score.trust_in_support = 0;
  poses::grade(sought, little);
  CHECK(little.rank == little.quality);
}

TEST_CASE("what the clues say moves the rank, by as much as they are trusted", "[poses]") {
  SoughtBody body({kBody});
  const poses::Sought sought = body.sought();
  poses::Candidate sure = body.candidate(beside(0)), doubtful = sure;
  poses::judge(sought, sure, {});
  doubtful.fit = sure.fit;
  doubtful.fit.overhang = doubtful.fit.ends / 2;  // as a piece of a wall has it
  poses::grade(sought, doubtful);
  const double odds =
      poses::first_log_odds(sure, sought.terms) - poses::first_log_odds(doubtful, sought.terms);
  CHECK(odds > 2);
  CHECK(sure.rank / doubtful.rank ==
        Approx(sure.quality / doubtful.quality * std::exp(0.1 * odds)).epsilon(1e-6));
  doubtful.fit.supported = 0;
  poses::grade(sought, doubtful);
  CHECK(doubtful.rank == 0);
}

TEST_CASE("consensus is the share of the features there that had voted", "[poses]") {
  const SoughtBody body({kBody});
  poses::Sought sought = body.sought();
  const auto features = static_cast<double>(body.scan.count_explained(
      body.model, *sought.model_index, beside(0), sought.params.tolerance, sought.voters));
  REQUIRE(features > 50);
  sought.votes_per_correspondence = 30;
  const auto consensus = [&](double support) {
    return poses::consensus(poses::votes_per_feature(sought, body.candidate(beside(0), support)),
                            body.params.terms.score);
  };
  CHECK(consensus(2 * features) == 1);
  CHECK(consensus(0.1 * features) == Approx(std::pow(0.1, 0.15)));
  sought.votes_per_correspondence = 60;  // support grows with the votes
  CHECK(consensus(0.2 * features) == Approx(std::pow(0.1, 0.15)));
}

TEST_CASE("a pose convinces by score and confidence; a rival's has no consensus", "[poses]") {
  SoughtBody body({kBody});
  body.params.min_score = 0.75;
  poses::Sought sought = body.sought();
  poses::Candidate lonely = body.candidate(beside(0), 0.1);
  poses::judge(sought, lonely, {});
  poses::believe(sought, lonely);
  REQUIRE(lonely.quality > 0.8);
  CHECK(poses::is_convincing(sought, lonely));
  CHECK(lonely.score() == lonely.quality);
  lonely.confidence = 0.3;  // doubtful
  CHECK(poses::is_convincing(sought, lonely));
  lonely.confidence = 0.1;
  CHECK_FALSE(poses::is_convincing(sought, lonely));
  sought.votes_per_correspondence = 60;
  poses::believe(sought, lonely);
  lonely.confidence = 1;
  CHECK_FALSE(poses::is_convincing(sought, lonely));
  CHECK(lonely.score() < 0.5 * lonely.quality);
}

TEST_CASE("others are judged by the residual and the tint of an instance", "[poses]") {
  SoughtBody body({kBody});
  poses::Candidate instance = body.candidate(beside(0));
  instance.fit.supported = 100, instance.fit.systematic = 1e-3;
  instance.colors.emplace();
  instance.colors->has_tint = true;
  instance.colors->tint = {8, -4};
  body.scan.learn_from(body.model, instance);
  poses::Fit off = instance.fit;
  off.systematic = 3e-3;
  const auto exactness = [&] { return body.scan.usual_residual.exactness(off, 0.8, {1, 0}); };
  CHECK(exactness() == 1);  // nobody believes it
  instance.confidence = 0.6;
  body.scan.learn_from(body.model, instance);
  CHECK(exactness() == Approx(1 / 3.0).margin(1e-3));  // of ranges that hardly differ
  CHECK(body.scan.usual_tint.tint().isApprox(Eigen::Vector2d(4, -2)));
}

TEST_CASE("what leaves more than the instances before is less exact, once refined", "[poses]") {
  SoughtBody body({kBody});
  poses::Fit exact;
  exact.supported = 100;
  body.scan.usual_residual.add(exact, 0.8);
  poses::Candidate off = body.candidate(beside(0.004));
  poses::judge(body.sought(), off, poses::kAllPoints);
  poses::measure_residual(body.sought(), off, 0);
  const double rough = off.quality;
  off.is_refined = true;
  REQUIRE(off.fit.systematic > 0.05 * 2 * kResolution);
  poses::grade(body.sought(), off);
  const double exactness = poses::exactness(body.sought(), off);
  CHECK(exactness < 0.8);
  CHECK(off.quality == Approx(std::max(0.6, exactness) * rough));
  body.params.terms.score.least_exactness = 0.9;
  poses::grade(body.sought(), off);
  CHECK(off.quality == Approx(0.9 * rough));
  body.params.refine = false;
  CHECK(poses::exactness(body.sought(), off) == 1);
}

}  // namespace posevote::score_test
