// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/object_search.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::object_search_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

/// The search's best, of the body turned over, which has by far the most support, and of the body
/// itself, moved so far from there [m].
std::optional<Candidate> best_of_turned_and_moved(double metres, double sure) {
  SoughtBody body({kBody});
  body.params.min_confidence = body.params.min_score = 0;
  body.params.terms.schedule.finalists = 1;
  body.params.terms.schedule.sure = sure;
  body.params.terms.score.trust_in_support = 5;
  body.params.refine = false;
  const std::vector<Hypothesis> proposals{body.hypothesis(beside(0, std::numbers::pi), 1000),
                                          body.hypothesis(beside(metres), 10)};
  ObjectSearch search(body.sought(),
                      {[&] { return proposals; }, [](const Hypothesis& one) { return one; }});
  search.propose();
  return search.best();
}

double turn_from_body(const Candidate& candidate) {
  return Eigen::AngleAxisd(candidate.T_scene_model.linear().transpose() *
                           kBody.T_scene_model.linear())
      .angle();
}

}  // namespace

TEST_CASE("before its place is closed, what else was proposed there is refined", "[poses]") {
  const auto here = best_of_turned_and_moved(0.002, 0.95);
  REQUIRE(here);
  CHECK(turn_from_body(*here) < 0.1);
  const auto elsewhere = best_of_turned_and_moved(0.05, 0.95);  // has its own turn, later
  REQUIRE(elsewhere);
  CHECK(turn_from_body(*elsewhere) > 3);
  const auto sure = best_of_turned_and_moved(0.002, 0);  // nobody else is asked
  REQUIRE(sure);
  CHECK(turn_from_body(*sure) > 3);
}

TEST_CASE("once something was taken out, more is asked for, of what convinced nobody if wanted",
          "[poses]") {
  const auto asks_again = [](const Eigen::Isometry3d& proposed, int candidates, int shortlist) {
    SoughtBody body({kBody});
    body.params.candidates = candidates;
    body.params.terms.schedule.shortlist_again = shortlist;
    const std::vector<Hypothesis> proposals{body.hypothesis(proposed)};
    ObjectSearch search(body.sought(),
                        {[&] { return proposals; }, [](const Hypothesis& one) { return one; }});
    CHECK(search.may_propose());
    search.propose();
    CHECK_FALSE(search.may_propose());
    if (search.best()) search.accept();
    body.scan.take_out(body.model, kBody.T_scene_model, 0.01F);
    return search.may_propose();
  };
  CHECK_FALSE(asks_again(beside(0.4), 1000, 0));
  CHECK(asks_again(beside(0.4), 1000, 1));
  CHECK(asks_again(beside(0), 1000, 0));
  CHECK(asks_again(beside(0.4), 1, 1));  // the paper's: the densest mode may be a false one
}

TEST_CASE("what convinced nobody is found among what is proposed again", "[poses]") {
  SoughtBody body({kBody});
  body.params.terms.schedule.shortlist_again = 1;
  std::vector<Hypothesis> proposals{body.hypothesis(beside(0.4), 1000)};
  ObjectSearch search(body.sought(),
                      {[&] { return proposals; }, [](const Hypothesis& one) { return one; }});
  search.propose();
  CHECK_FALSE(search.best());
  body.scan.take_out(body.model, beside(0.4), 0.01F);
  proposals.push_back(body.hypothesis(beside(0.002), 10));
  search.propose();
  REQUIRE(search.best());
  CHECK(distance_to_body(search.best()->T_scene_model) < 1e-3);
}

TEST_CASE("of many instances none need lead over more than the least of those found", "[poses]") {
  const std::vector<Placed> bodies{kBody, {1, beside(0.3)}, {1, beside(-0.3)}};
  SoughtBody body(bodies);
  body.params.max_instances = 3;
  const std::vector<Hypothesis> proposals{body.hypothesis(bodies[0].T_scene_model, 1000),
                                          body.hypothesis(bodies[1].T_scene_model, 400),
                                          body.hypothesis(bodies[2].T_scene_model, 50)};
  ObjectSearch search(body.sought(),
                      {[&] { return proposals; }, [](const Hypothesis& one) { return one; }});
  search.propose();
  for (const double elsewhere : {400, 1000, 400}) {
    REQUIRE(search.best());
    CHECK(search.best()->elsewhere == elsewhere);
    const Eigen::Isometry3d T_scene_model = search.best()->T_scene_model;
    search.accept();
    body.scan.take_out(body.model, T_scene_model, 0.01F);
    search.choose();
  }
}

TEST_CASE("near a point a search looks at what is proposed there, and may be told to prefer it",
          "[poses]") {
  SoughtBody body({kBody});
  body.params.max_instances = 2;
  const std::vector<Hypothesis> proposals{body.hypothesis(beside(0.4), 1000),
                                          body.hypothesis(beside(0.002), 10)};
  ObjectSearch search(body.sought(),
                      {[&] { return proposals; }, [](const Hypothesis& one) { return one; }});
  const auto look = [&](double metres) {
    return search.look_near(posed_center(beside(metres), body.model.center), 0.05);
  };
  CHECK(look(0.4).empty());  // nothing is there
  const Candidates there = look(0);
  REQUIRE(there.size() == 1);
  CHECK(there[0].confidence > 0.5);
  CHECK(distance_to_body(there[0].T_scene_model) < 1e-3);
  CHECK(there[0].elsewhere == 1000);  // the lead is over all that was proposed
  CHECK_FALSE(search.best());
  REQUIRE(search.prefer(there[0]));
  CHECK(search.is_current());
  REQUIRE(search.best());
  CHECK(search.best()->covariance);
  search.accept();
  CHECK(look(0).empty());  // its place is closed
  CHECK_FALSE(search.prefer(there[0]));
}

}  // namespace posevote::object_search_test
