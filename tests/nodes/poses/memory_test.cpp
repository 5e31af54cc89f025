// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/memory.hpp"

#include <catch2/catch.hpp>

#include "nodes/poses/refinement.hpp"
#include "nodes/poses/score.hpp"
#include "tests/nodes/poses/sought_body.hpp"

namespace posevote::memory_test {

using namespace posevote::test;

namespace {

const Placed kOther{1, pose(0.25, -0.02, 0.9, 1.9)};

void take_out(SoughtBody& body, const Placed& placed) {
  body.scan.take_out(body.model, placed.T_scene_model, 3 * kResolution);
}

}  // namespace

TEST_CASE("an answer is remembered until what it depends on is taken out of the scan", "[poses]") {
  SoughtBody body({kBody, kOther});
  poses::Answers<int> answers;
  int asked = 0;
  const auto ask = [&](const Placed& placed, std::int64_t how = 0) {
    return answers.get(body.scan, {placed.T_scene_model, how}, [&] {
      const Eigen::Vector3d place = placed.T_scene_model.translation();
      return poses::Answer<int>{++asked, Eigen::AlignedBox3d(place), 0.08};
    });
  };
  CHECK(ask(kBody) == 1);
  CHECK(ask(kBody, 1) == 2);  // another question
  CHECK(ask(kOther) == 3);
  CHECK(ask(kBody) == 1);
  take_out(body, kOther);
  CHECK(ask(kBody) == 1);
  CHECK(ask(kOther) == 4);
  CHECK(ask(kOther) == 4);
  take_out(body, kBody);
  CHECK(ask(kBody) == 5);
  CHECK(ask(kOther) == 4);
}

TEST_CASE("who remembers judges and refines as who does not, whatever is taken out", "[poses]") {
  SoughtBody body({kBody, kOther});
  const poses::Sought remembers = body.sought();
  const auto check = [&](const Eigen::Isometry3d& T_scene_model) {
    poses::Sought forgetful = remembers;
    forgetful.memory = std::make_shared<poses::Memory>();
    poses::Candidate one = body.candidate(T_scene_model), other = one;
    for (const auto step : {poses::take_first_steps, poses::refine, poses::polish}) {
      step(remembers, one);
      step(forgetful, other);
      CHECK(one.T_scene_model.matrix() == other.T_scene_model.matrix());
      CHECK(one.quality == other.quality);
      CHECK(one.confidence == other.confidence);
      CHECK(one.fit.supported == other.fit.supported);
    }
    return one.fit.supported;
  };
  // The last one starts so far off that the other body is beyond its reach only at the start.
  const std::vector<Eigen::Isometry3d> starts{beside(0.01, 0.2), beside(0.25, 0.3), beside(0.13)};
  for (const Eigen::Isometry3d& start : starts) check(start);
  const std::size_t before = check(starts[0]);
  take_out(body, kOther);
  for (const Eigen::Isometry3d& start : starts) check(start);
  CHECK(check(starts[0]) == before);
  take_out(body, kBody);
  for (const Eigen::Isometry3d& start : starts) check(start);
  CHECK(check(starts[0]) < before / 10);
}

}  // namespace posevote::memory_test
