// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/pool.hpp"

#include <catch2/catch.hpp>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::pool_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

std::vector<double> supports(const poses::Candidates& pool) {
  std::vector<double> all;
  for (const poses::Candidate& one : pool) all.push_back(one.proposed.support);
  return all;
}

using Supports = std::vector<double>;

}  // namespace

TEST_CASE("proposals that lie apart become candidates, at most so many", "[poses]") {
  SoughtBody body({kBody});
  const float nms = body.sought().params.nms_radius;  // proposals lie a third of it apart
  const std::vector<Hypothesis> proposals{
      body.hypothesis(beside(0), 9), body.hypothesis(beside(0.2 * double(nms)), 8),
      body.hypothesis(beside(0.5 * double(nms)), 7), body.hypothesis(beside(0, 2), 6),
      body.hypothesis(beside(0.3), 5)};
  const poses::TakenPlaces none(nms);
  poses::Sought sought = body.sought();
  const poses::Candidates pool = poses::collect(sought, proposals, none);
  CHECK(supports(pool) == Supports{9, 7, 6, 5});
  CHECK(sought.most_support == 9);
  CHECK(pool[0].elsewhere == 5);  // others lie within a fifth of the diagonal
  CHECK(pool[3].elsewhere == 9);
  CHECK(pool[0].T_scene_model.isApprox(beside(0), 1e-5));
  body.params.terms.pool.proposed_fineness = 10;
  CHECK(supports(poses::collect(sought, proposals, none)) == Supports{9, 8, 7, 6, 5});
  sought.params.candidates = 2;
  CHECK(supports(poses::collect(sought, proposals, none)) == Supports{9, 8});
}

TEST_CASE("nothing is proposed where an instance is, or was proposed", "[poses]") {
  const SoughtBody body({kBody});
  poses::Sought sought = body.sought();
  const double nms = double(sought.params.nms_radius);
  poses::TakenPlaces taken(sought.params.nms_radius);
  poses::Candidate instance = body.candidate(beside(0.2));
  instance.T_scene_model = beside(0);  // ICP moved it
  taken.take(body.model, instance);
  CHECK_FALSE(taken.is_clear(sought, beside(0.9 * nms)));
  CHECK(taken.is_clear(sought, beside(1.1 * nms)));
  CHECK_FALSE(taken.is_clear(sought, beside(0.2 - 0.9 * nms)));
  const poses::Candidates pool = poses::collect(
      sought, {body.hypothesis(beside(0.5 * nms), 9), body.hypothesis(beside(0.1), 3)}, taken);
  CHECK(supports(pool) == Supports{3});
  CHECK(sought.most_support == 3);
}

TEST_CASE("bodies are solid: where one was found, another object has no room", "[poses]") {
  SoughtBody body({kBody});
  const poses::Sought sought = body.sought();
  const poses::TakenPlaces none(0);
  const double width = double(body.model.diagonal);
  poses::Candidate instance = body.candidate(beside(0));
  instance.confidence = 0.4;  // it may not be there
  body.scan.learn_from(body.model, instance);
  CHECK(none.is_clear(sought, beside(0.3 * width)));
  instance.confidence = 0.6;
  body.scan.learn_from(body.model, instance);
  CHECK_FALSE(none.is_clear(sought, beside(0.3 * width)));
  CHECK(none.is_clear(sought, beside(width)));
  poses::Sought hollow = body.sought();
  hollow.params.overlap = 1;
  CHECK(none.is_clear(hollow, beside(0.3 * width)));
  for (int i = 0; i < 10; ++i) body.scan.learn_from(body.model, instance);
  CHECK(body.scan.share_inside(body.model, beside(0.3 * width)) == 1);
  CHECK(none.is_clear(hollow, beside(0.3 * width)));
}

TEST_CASE("once judged, the best stands for its place, with the highest support there", "[poses]") {
  const SoughtBody body({kBody});
  const poses::Sought sought = body.sought();
  const double nms = double(sought.params.nms_radius);
  poses::Candidates pool{body.candidate(beside(0.4 * nms), 2), body.candidate(beside(0), 7),
                         body.candidate(beside(0, 2), 4), body.candidate(beside(3 * nms), 3)};
  poses::leave_out_likes(sought, pool);
  std::vector<double> kept = supports(pool);
  std::sort(kept.begin(), kept.end());
  CHECK(kept == Supports{3, 4, 7});
  for (const poses::Candidate& one : pool)
    if (one.proposed.support == 7) CHECK(distance_to_body(one.T_scene_model) > 0.3 * nms);
  CHECK(std::is_sorted(
      pool.begin(), pool.end(),
      [](const poses::Candidate& a, const poses::Candidate& b) { return a.rank > b.rank; }));
}

}  // namespace posevote::pool_test
