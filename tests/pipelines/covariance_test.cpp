// SPDX-License-Identifier: BSD-3-Clause
// The covariances of a run hold what they say, as `posevote evaluate` measures it.
#include <cmath>

#include "tests/pipelines/run_world.hpp"

namespace posevote::covariance_test {

using namespace posevote::test;

TEST_CASE("true errors of right detections lie within the 95 % ellipsoid", "[run]") {
  const World& w = world();
  const std::string spec =
      w.folder.write("ellipsoids.yaml",
                     "seed: 8\n"
                     "models:\n"
                     "  - {shape: figure, seed: 3, size: 0.2}\n"
                     "  - {shape: kettle, seed: 4, size: 0.16}\n"
                     "scenes:\n"
                     "  - {count: 3, sensor: laser, objects: [1, 2], clutter: 1}\n"
                     "  - {count: 4, sensor: rgbd, objects: [1, 2], clutter: 1}\n"
                     "  - {count: 3, sensor: plain, noise: 0.001, objects: [1, 2], clutter: 1}\n");
  const std::string data = (w.folder / "ellipsoids").string(),
                    out = (w.folder / "ellipsoids_out").string();
  REQUIRE(run_posevote(w.folder, "simulate " + spec + " --out " + data).status == 0);
  REQUIRE(run_posevote(w.folder, "run demo --dataset " + data + " --out " + out +
                                     " --set write_picture.every=0 --set write_overlay.every=0")
              .status == 0);
  for (const char* file : {"/results.json", "/results.csv"}) {
    const CommandResult judged = run_posevote(
        w.folder, "evaluate " + data + " " + out + file + " --rules pose --out " + out + "/judged");
    INFO(judged.output);
    REQUIRE(judged.status == 0);
    const nlohmann::json all =
        read_json(w.folder / "ellipsoids_out/judged/evaluation.json")["all"][0];
    CHECK(all["with_covariance"] >= 15);
    CHECK(all["in_95"] >= 0.8);  // 15 of 18 at least: chance alone leaves it once in 500 sets
  }
  // Nor are they far larger than what a scan of a few mm of noise tells: a turn of two degrees.
  for (const nlohmann::json& frame : read_json(w.folder / "ellipsoids_out/results.json")["frames"])
    for (const nlohmann::json& detection : frame["detections"])
      for (int i = 3; i < 6; ++i)
        CHECK(std::sqrt(detection["covariance"][7 * i].get<double>()) < 2 / 57.3);
}

}  // namespace posevote::covariance_test
