// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/peek.hpp"

#include <catch2/catch.hpp>

#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::peek_test {

using namespace posevote::poses;
using namespace posevote::test;

namespace {

using Numbers = std::vector<std::size_t>;

/// Poses before what the sensor saw, and behind these, of the least support, the true one.
std::vector<Hypothesis> true_one_last(const SoughtBody& body) {
  std::vector<Hypothesis> proposals;
  for (int i = 1; i <= 5; ++i) {
    Eigen::Isometry3d nearer = kBody.T_scene_model;
    nearer.translation().z() -= 0.03 * i;
    proposals.push_back(body.hypothesis(nearer, 100 - i));
  }
  proposals.push_back(body.hypothesis(kBody.T_scene_model, 10));
  return proposals;
}

}  // namespace

TEST_CASE("a peek tells a pose from those that the sensor saw through", "[poses]") {
  SoughtBody body({kBody});
  const std::vector<Hypothesis> proposals = true_one_last(body);
  const auto worth = [&](int glances, const Numbers& numbers) {
    body.params.terms.schedule.glances = glances;
    return worth_a_glance(body.sought(), proposals, numbers);
  };
  const Numbers all{0, 1, 2, 3, 4, 5};
  CHECK(worth(6, all) == all);
  CHECK(worth(1, all) == Numbers{5});
  const Numbers some = worth(3, all);
  REQUIRE(some.size() == 3);
  CHECK(some[0] < some[1]);  // by support, as they came
  CHECK(some[2] == 5);
  CHECK(worth(1, {1, 3}).size() == 1);
  CHECK(worth(1, {}).empty());
  body.scan.take_out(body.model, beside(0.4), 0.01F);  // the range image does not know
  CHECK(worth(1, all) == Numbers{0});
}

TEST_CASE("without a single view the best supported are glanced at", "[poses]") {
  SoughtBody body({kBody});
  body.params.terms.schedule.glances = 2;
  Cloud from_within = body.cloud;
  from_within.normals *= -1;
  const ScanState scan(from_within, body.features, kResolution);
  REQUIRE_FALSE(scan.view.usable());
  const Sought sought{body.model, scan, instance_params(body.params, body.model, kResolution),
                      body.params.terms};
  CHECK(worth_a_glance(sought, true_one_last(body), {0, 1, 4, 5}) == Numbers{0, 1});
}

}  // namespace posevote::peek_test
