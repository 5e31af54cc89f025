// SPDX-License-Identifier: BSD-3-Clause
// ADD-S, and confidences in the place of scores.
#include <cmath>

#include "tests/tools/truth_set.hpp"

namespace posevote::evaluate_adds_test {

using namespace posevote::test;
using Catch::Contains;

TEST_CASE("ADD-S takes any pose that looks alike, ADD the right one", "[evaluate]") {
  const TruthSet set;
  EvaluateOptions options;
  options.rules = "add,adds";
  // Turned by half about its own centre, (10, 0, 0); object 1 is not declared symmetric.
  const Evaluation got = set.evaluate(
      row(1, 0.9, kFlip, "20 0 1000") + row(1, 0.8, kIdentity, "300 25 1000"), options);
  CHECK(got.instances[0].met == std::vector<double>{0, 1});
  CHECK(got.instances[1].met == std::vector<double>{0, 1});  // ADD 25 mm, 20.5 are allowed
  CHECK(got.all[1].counts.correct == 2);
  CHECK(got.instances[0].errors.adds < 0.002);
  CHECK(calibration_error(got.all[1]) == Approx((0.1 + 0.2) / 2));
  CHECK_THAT(to_text(got, false), Contains("ADD-S 0.1 diameter") && Contains("ECE"));
  const auto way_round = right_way_round(got);
  CHECK(way_round.at(0).found == 2);
  CHECK(way_round.at(0).right == 0);
  CHECK_THAT(to_text(got, false), Contains("ADD where ADD-S is met     0.000   0 of 2"));
  options.rules = "adds";
  CHECK(right_way_round(set.evaluate(row(1, 0.9, kFlip, "20 0 1000"), options)).empty());
}

TEST_CASE("a column of confidences takes the place of the scores", "[evaluate]") {
  const TemporaryFolder folder;
  const std::string header = "scene_id,im_id,obj_id,score,R,t,time,confidence\n";
  const std::string rest = "," + kIdentity + ",0 0 1000,0.1";
  const auto rows = read_results_csv(folder.write("a.csv", header + "1,3,1,7" + rest + ",0.5\n"));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].score == 0.5);
  CHECK_THROWS_WITH(read_results_csv(folder.write("b.csv", header + "1,3,1,7" + rest + "\n")),
                    Contains("b.csv:2: has 7 fields, expected 8"));
}

}  // namespace posevote::evaluate_adds_test
