// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/schedule.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::schedule_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

/// Ever farther from the body; the nearest comes last.
poses::Candidates far_to_near(const SoughtBody& body, int count) {
  poses::Candidates pool;
  for (int i = count - 1; i >= 0; --i) pool.push_back(body.candidate(beside(0.004 * i)));
  return pool;
}

}  // namespace

TEST_CASE("the shortlist keeps the best, by a glance", "[poses]") {
  const SoughtBody body({kBody});
  poses::Candidates pool = far_to_near(body, 12);
  poses::make_shortlist(body.sought(), pool, 3);
  REQUIRE(pool.size() == 3);
  CHECK(distance_to_body(pool[0].T_scene_model) < 0.005);
  CHECK(pool[0].fit.facing < 60);
  CHECK(pool[0].fit.facing > 10);
  poses::Candidates few{body.candidate(beside(0.1)), body.candidate(beside(0))};
  poses::make_shortlist(body.sought(), few, 3);  // there is room for all: nobody looks
  CHECK(few[0].fit.facing == 0);
}

TEST_CASE("nobody far behind the best at a glance is on the shortlist", "[poses]") {
  SoughtBody body({kBody});
  const auto kept = [&](double share) {
    body.params.terms.schedule.sketch_hopeless = share;
    poses::Candidates pool = far_to_near(body, 12);
    poses::make_shortlist(body.sought(), pool, 11);
    for (const poses::Candidate& one : pool) CHECK(one.rank >= share * pool[0].rank);
    return pool.size();
  };
  CHECK(kept(0) == 11);
  CHECK(kept(1) == 1);
  CHECK(kept(0.5) > 1);
  CHECK(kept(0.5) < 11);
}

TEST_CASE("the sketch is of improved poses, the best first", "[poses]") {
  const SoughtBody body({kBody});
  poses::Candidates pool{body.candidate(beside(0.3)), body.candidate(beside(0.1))};
  poses::sketch(body.sought(), pool, [&](const Hypothesis& one) {
    Hypothesis better = one;  // by 10 cm
    better.center.x() -= 0.1F;
    return better;
  });
  CHECK(distance_to_body(pool[0].T_scene_model) < 1e-5);
  CHECK(pool[0].quality > 0.8);
  CHECK(pool[1].quality < 0.1);
}

TEST_CASE("the promising are brought closer, the others stay", "[poses]") {
  SoughtBody body({kBody});
  body.params.terms.schedule.promising = 1;
  poses::Candidates pool{body.candidate(beside(0.012)), body.candidate(beside(-0.012))};
  poses::bring_closer(body.sought(), pool);
  CHECK(distance_to_body(pool[0].T_scene_model) < 0.008);
  CHECK(pool[1].T_scene_model.matrix() == beside(-0.012).matrix());
}

TEST_CASE("nobody far behind the best sketch is brought closer", "[poses]") {
  SoughtBody body({kBody});
  const auto moved = [&](double share) {
    body.params.terms.schedule.closer_hopeless = share;
    poses::Candidates pool{body.candidate(beside(0.012)), body.candidate(beside(-0.012))};
    pool[0].rank = 1, pool[1].rank = 0.2;
    poses::bring_closer(body.sought(), pool);
    return std::ranges::count_if(pool, [](const poses::Candidate& one) {
      return distance_to_body(one.T_scene_model) < 0.011;
    });
  };
  CHECK(moved(0.1) == 2);
  CHECK(moved(0.3) == 1);
}

TEST_CASE("finalists are looked at in the order of their ranks, as far as needed", "[poses]") {
  SoughtBody body({kBody});
  body.params.terms.schedule.finalists = 1;
  poses::Candidates pool = far_to_near(body, 6);
  std::reverse(pool.begin(), pool.end());
  for (std::size_t i = 0; i < pool.size(); ++i) pool[i].rank = 0.01;  // bounds of before
  std::swap(pool[0], pool[1]);
  poses::bring_finalists_forward(body.sought(), pool);
  CHECK(distance_to_body(pool[0].T_scene_model) < 1e-6);
  CHECK(pool[0].fit.facing > 300);
  std::size_t looked_at = 0;
  for (const poses::Candidate& one : pool) looked_at += one.fit.facing > 0;
  CHECK(looked_at == 2);  // a batch
}

TEST_CASE("poses of no quality are nobody's finalists", "[poses]") {
  const SoughtBody body({kBody});
  poses::Candidates pool{body.candidate(beside(0.4)), body.candidate(beside(0))};
  poses::bring_finalists_forward(body.sought(), pool);
  REQUIRE(pool.size() == 1);
  CHECK(pool[0].quality > 0.8);
}

TEST_CASE("only what may turn out the best is refined", "[poses]") {
  SoughtBody body({kBody});
  const auto refined = [&](const std::vector<double>& ranks) {
    poses::Candidates pool;
    for (const double rank : ranks) {
      pool.push_back(body.candidate(beside(0)));
      pool.back().quality = pool.back().rank = rank;
    }
    return poses::refine_best(body.sought(), pool) - pool.begin();
  };
  CHECK(refined({0.9, 0.8, 0.7, 0.6, 0.5}) == 4);  // the finalists
  CHECK(refined({0.9, 0.8, 0.2, 0.2}) == 2);       // a quarter of the best one's rank
  CHECK(refined({0.02, 0.02}) == 0);               // a quarter of min_score
  body.params.terms.schedule.hopeless = 0;
  CHECK(refined({0.9, 0.8, 0.2, 0.2}) == 4);
  CHECK(refined({}) == 0);
}

TEST_CASE("what clues put far below the usual is not refined, but for the first", "[poses]") {
  SoughtBody body({kBody});
  poses::Candidate good = body.candidate(beside(0));
  poses::judge(body.sought(), good, {});
  poses::Candidate bad = good;
  bad.fit.apparent = {1, 99, 0};  // seen through
  REQUIRE(poses::may_win(body.sought(), good));
  REQUIRE(!poses::may_win(body.sought(), bad));
  bad.quality = bad.rank = 0.99 * good.rank;
  poses::Candidates pool{good, bad, good, bad, good};
  CHECK(poses::refine_best(body.sought(), pool) - pool.begin() == 3);  // the good ones came forward
  for (std::size_t i = 0; i < pool.size(); ++i) CHECK(pool[i].is_refined == (i < 3));
  poses::Candidates hopeless{bad, bad};
  CHECK(poses::refine_best(body.sought(), hopeless) - hopeless.begin() == 1);
  body.params.terms.schedule.hopeless_odds = -1e6;
  poses::Candidates all{bad, bad};
  CHECK(poses::refine_best(body.sought(), all) - all.begin() == 2);
}

}  // namespace posevote::schedule_test
