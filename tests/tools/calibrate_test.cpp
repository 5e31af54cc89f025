// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/support/command.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/calibrate/judged_poses.hpp"
#include "tools/calibrate/logistic.hpp"

namespace posevote::calibrate_test {

using namespace posevote::test;

TEST_CASE("logistic regression finds the odds that made the data", "[calibrate]") {
  constexpr Eigen::Index kRows = 20000;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Eigen::MatrixXd clues(kRows, 3);
  Eigen::VectorXd right(kRows);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    clues.row(i) << 5 + 2 * normal(random), 0.1 * normal(random), 7;
    const double log_odds = -4 + 1.0 * clues(i, 0) - 8.0 * clues(i, 1);
    right[i] = uniform(random) < 1 / (1 + std::exp(-log_odds));
  }
  const Logistic fitted = fit_logistic(clues, right, Eigen::VectorXd::Ones(kRows));
  CHECK(fitted.weights[0] == Approx(1).epsilon(0.05));
  CHECK(fitted.weights[1] == Approx(-8).epsilon(0.05));
  CHECK(fitted.weights[2] == Approx(0).margin(1e-6));  // never varies
  CHECK(fitted.offset == Approx(-4).epsilon(0.06));
  CHECK(fitted.probability(Eigen::Vector3d(4, 0, 7)) == Approx(0.5).margin(0.02));
  CHECK_THROWS_WITH(fit_logistic(clues, Eigen::VectorXd::Ones(kRows), right),
                    Catch::Contains("some that are wrong"));
}

TEST_CASE("what separates perfectly still has finite weights", "[calibrate]") {
  Eigen::MatrixXd clues(6, 1);
  clues << -3, -2, -1, 1, 2, 3;
  Eigen::VectorXd right(6);
  right << 0, 0, 0, 1, 1, 1;
  const Logistic fitted = fit_logistic(clues, right, Eigen::VectorXd::Ones(6));
  CHECK(fitted.weights[0] > 0);
  CHECK(fitted.weights[0] < 10);
}

TEST_CASE("results of another build have no clues", "[calibrate]") {
  const TemporaryFolder folder;
  folder.write("results.json",
               "{\"frames\": [\n{\"frame\": 0, \"scene_id\": 1, \"im_id\": 2, \"detections\": "
               "[{\"obj_id\": 1}]}"
               "\n],\n\"nodes\": []}\n");
  CHECK_THROWS_WITH(judge_poses(folder.path(), folder.path(), "adds"),
                    Catch::Contains("results.json") && Catch::Contains("not of this build"));
}

TEST_CASE("calibrate refuses what is no set", "[calibrate]") {
  const TemporaryFolder folder;
  const CommandResult result =
      run_posevote(folder, "calibrate nothing --out " + (folder / "out").string());
  CHECK(result.status == 2);
  CHECK_THAT(result.output, Catch::Contains("nothing"));
}

}  // namespace posevote::calibrate_test
