// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/find_instances.hpp"

#include <catch2/catch.hpp>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::find_instances_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

/// Of the body what looks to the sensor: fits as well, and says less.
Model front_of(const Model& body) {
  const Eigen::Vector3d back =
      kBody.T_scene_model.linear().transpose() * kBody.T_scene_model.translation().normalized();
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < body.cloud.points.rows(); ++i)
    if (body.cloud.points.row(i).normalized().dot(back.cast<float>()) < -0.5F) rows.push_back(i);
  Model front = body;
  front.obj_id = 2;
  front.cloud = geometry::select_rows(body.cloud, rows);
  // Where it was cut the scan goes on, so that is no end.
  front.outline.bends.clear();
  front.outline.ends.clear();
  front.outline.gaps.clear();
  for (const Eigen::Index row : rows) {
    front.outline.ends.push_back(body.outline.ends[static_cast<std::size_t>(row)]);
    front.outline.gaps.push_back(body.outline.gaps[static_cast<std::size_t>(row)]);
  }
  return front;
}

/// What is found of the body (object 0), which is proposed when it was asked for so often, and of
/// its front (1).
std::vector<Instance> found_where_body_comes_at(int asked) {
  SoughtBody body({kBody});
  const Model front = front_of(body.model);
  const Sought whole = body.sought();
  const Sought sought_front{front, body.scan, whole.params, whole.terms, 0, whole.voters};
  const Improve as_it_is = [](const Hypothesis& one) { return one; };
  const std::vector<Hypothesis> proposals{body.hypothesis(beside(0.002))};
  int times = 0;
  std::vector<ObjectSearch> searches;
  searches.emplace_back(
      body.sought(),
      Proposals{[&] { return ++times < asked ? std::vector<Hypothesis>() : proposals; }, as_it_is});
  searches.emplace_back(sought_front, Proposals{[&] { return proposals; }, as_it_is});
  return find_instances(searches, body.scan).found;
}

}  // namespace

TEST_CASE("before a doubtful pose is taken, other objects look once more where it is", "[poses]") {
  const std::vector<Instance> alone = found_where_body_comes_at(1000);
  REQUIRE(alone.size() == 1);
  CHECK(alone[0].object == 1);
  CHECK(alone[0].candidate.confidence < 0.95);
  for (const int asked : {1, 2}) {
    const std::vector<Instance> both = found_where_body_comes_at(asked);
    REQUIRE(both.size() == 1);
    CHECK(both[0].object == 0);
  }
}

}  // namespace posevote::find_instances_test
