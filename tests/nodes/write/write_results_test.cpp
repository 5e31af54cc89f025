// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "nodes/data/files.hpp"
#include "nodes/formats/results_files.hpp"
#include "tests/nodes/write/writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::write_results_test {

using namespace posevote::test;

namespace {

/// The node with its state, as a run has it.
struct Writer {
  const graph::NodeSpec* spec = graph::find_node("write_results");
  std::shared_ptr<void> params = spec->make_params();
  std::shared_ptr<void> state = spec->make_state(params.get());

  void write(const graph::FrameContext& frame, const Detections& detections) const {
    const SceneFile file{frame.file, 3, static_cast<int>(frame.number), {}};
    spec->call(
        {std::make_shared<const SceneFile>(file), std::make_shared<const Detections>(detections)},
        frame, params.get(), state.get());
  }
  void fail(const graph::FrameContext& frame, const graph::Failure& failure) const {
    spec->on_failure(state.get(), failure, frame, params.get());
  }
};

graph::FrameContext frame(std::size_t number, const std::filesystem::path& out) {
  return {number,
          "a",
          out,
          0,
          "scans/a.ply",
          {{"load_scene", {1e6, 3e6, 0, 15e5}, {{"sensor_pose", {0, 0, 2}}}, {"far away"}},
           {"skipped", {}},
           {"match", {2e6, 5e6, 1, 25e5}, {{"spacing_m", {0.25}}}}}};
}

nlohmann::json json(const std::filesystem::path& file) {
  return nlohmann::json::parse(read_text(file));
}

}  // namespace

TEST_CASE("write_results writes what is found and what failed, with the times of all stages",
          "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder.path());
  const Writer writer;
  CHECK(writer.spec->last);
  writer.write(frame(0, folder.path()), {{make_detection({0, 0, 1})}});
  writer.fail(frame(1, folder.path()), {"match", "no features"});
  writer.write(frame(2, folder.path()), {});

  const nlohmann::json results = json(folder / "results.json");
  REQUIRE(results["frames"].size() == 2);
  const nlohmann::json& first = results["frames"][0];
  CHECK(first["file"] == "scans/a.ply");
  CHECK(first["scene_id"] == 3);
  CHECK(first["seconds"] == 4);  // the shares of both
  CHECK(first["stages"] == nlohmann::json({{"load_scene", 1.5}, {"match", 2.5}}));
  CHECK(first["sensor_pose"] == nlohmann::json({0.0, 0.0, 2.0}));
  CHECK(first["spacing_m"] == 0.25);
  CHECK(first["warnings"] == nlohmann::json({{{"node", "load_scene"}, {"what", "far away"}}}));
  CHECK(first["detections"].size() == 1);
  CHECK(results["frames"][1]["frame"] == 2);
  REQUIRE(results["nodes"].size() == 3);
  CHECK(results["nodes"][0]["calls"] == 3);  // of failed frames, too
  CHECK(results["nodes"][1]["calls"] == 0);
  CHECK(results["nodes"][2]["total_s"] == 9);
  nlohmann::json failures = json(folder / "failures.json");
  CHECK(failures[0].erase("checksum") == 1);
  CHECK(failures ==
        nlohmann::json(
            {{{"frame", 1}, {"file", "scans/a.ply"}, {"node", "match"}, {"what", "no features"}}}));
  CHECK(read_text(folder / "results.csv").find("\n3,0,1,0.75") != std::string::npos);
}

TEST_CASE("write_results writes nothing where there is no output folder", "[write]") {
  const Writer writer;
  CHECK_NOTHROW(writer.write(frame(0, {}), {}));
  CHECK_NOTHROW(writer.fail(frame(1, {}), {"match", "no features"}));
}

TEST_CASE("results that cannot be written end the run", "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder.path());
  const Writer writer;
  writer.write(frame(0, folder.path()), {{make_detection({0, 0, 1})}});
  {
    const FullDisk full(std::filesystem::file_size(folder / "results.csv") + 10);
    CHECK_THROWS_AS(writer.write(frame(1, folder.path()), {{make_detection({0, 0, 1})}}),
                    graph::EndOfRun);
  }
  CHECK(json(folder / "results.json")["frames"].size() == 1);
  const Writer other;
  CHECK_THROWS_AS(other.write(frame(0, folder / "nowhere"), {}), graph::EndOfRun);
}

}  // namespace posevote::write_results_test
