// SPDX-License-Identifier: BSD-3-Clause
// A screw under a microscope and a car before a laser: every length that matters follows from the
// models and the scan, so that the same scene in another size has the same answer.
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/write_ply.hpp"
#include "tests/pipelines/run_world.hpp"

namespace posevote::any_size_test {

using namespace posevote::test;

namespace {

/// What is found where all of the world is so many times as large. Of a power of two no number is
/// rounded otherwise.
nlohmann::json detections_at(double times) {
  const std::string name = "size" + std::to_string(times);
  const fs::path models = world().folder / name / "models", scan = world().folder / name / "1.ply";
  fs::create_directories(models);
  for (const char* model : {"obj_000001.ply", "obj_000002.ply"})
    formats::write_ply(models / model, formats::read_mesh(world().models / model, 0.001), times);
  formats::write_ply(scan, formats::read_mesh(world().scans / "000001.ply", 1), times);
  const CommandResult done =
      run_posevote(world().folder, "run --models " + models.string() + " --scenes " +
                                       scan.string() + " --model-unit m --scene-unit m --out " +
                                       (world().folder / name / "out").string());
  INFO(done.output);
  REQUIRE(done.status == 0);
  return frames(name + "/out")[0].at("detections");
}

}  // namespace

TEST_CASE("the same scene is answered alike, however large it is", "[run]") {
  const nlohmann::json as_is = detections_at(1);
  REQUIRE(!as_is.empty());
  for (const double times : {1.0 / 32, 32.0}) {
    const nlohmann::json scaled = detections_at(times);
    REQUIRE(scaled.size() == as_is.size());
    for (std::size_t i = 0; i < as_is.size(); ++i) {
      INFO(times << " times as large: " << scaled[i]);
      for (const char* same : {"obj_id", "confidence", "density", "inlier_fraction", "q_wxyz"})
        CHECK(scaled[i].at(same) == as_is[i].at(same));
      for (std::size_t axis = 0; axis < 3; ++axis)
        CHECK(scaled[i].at("t_m")[axis].get<double>() ==
              times * as_is[i].at("t_m")[axis].get<double>());
    }
  }
}

}  // namespace posevote::any_size_test
