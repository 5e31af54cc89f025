// SPDX-License-Identifier: BSD-3-Clause
// What the project itself writes or has people write: YAML, libraries, results.
#include <memory>
#include <stdexcept>

#include "graph/problem.hpp"
#include "graph/yaml_reader.hpp"
#include "nodes/formats/results_files.hpp"
#include "nodes/formats/results_writer.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/configuration.hpp"
#include "tests/fuzz/reader.hpp"
#include "tests/nodes/match/small_library.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/evaluate/results_json.hpp"
#include "tools/manifest/manifest.hpp"
#include "tools/simulate/sensor_file.hpp"
#include "tools/simulate/spec.hpp"

namespace posevote::test {
namespace {

using Use = std::function<void(const std::string& file)>;

/// Writes the bytes into a file of that name, and then reads it.
Reader file_reader(const std::string& name, const std::string& file, const Use& use,
                   std::vector<Sample> samples) {
  const auto folder = std::make_shared<TemporaryFolder>();
  return {name,
          [=](std::string_view bytes) {
            std::filesystem::remove(*folder / file);  // to write over it would wait for the disk
            use(folder->write(file, std::string(bytes)));
          },
          std::move(samples)};
}

void read_pipeline(const std::string& file) {
  static const std::string base =
      "inputs: [x]\nresult: y\nnodes:\n  a: {in: x, out: q}\n  b: {in: x, out: z}\n  c: {in: x, "
      "out: w}\n";
  const auto beside = std::filesystem::path(file).replace_filename("base.yaml");
  if (!std::filesystem::exists(beside)) std::ofstream(beside) << base;
  std::vector<graph::Problem> problems;
  graph::read_pipeline(file, problems);
  if (!problems.empty()) throw graph::ConfigError(problems);
}

const std::string kKey(32, 'a');

void read_library(const std::string& file) {
  std::string why_not;
  if (!library::load_library(file, kKey, why_not)) throw std::runtime_error(why_not);
}

std::string library_bytes() {
  const TemporaryFolder folder;
  library::save_library(make_library({{0, 10, 11}, {100}}), folder / "library", kKey);
  return read_text(folder / "library");
}

/// What a run of one frame with one detection writes there.
std::string run_file(const std::string& name) {
  const TemporaryFolder folder;
  formats::begin_results(folder.path());
  formats::ResultsWriter writer(folder.path());
  formats::FrameReport frame;
  frame.name = "scan";
  frame.file.path = "scan.ply";
  Detection found;
  found.obj_id = 1;
  found.model = "part";
  found.score = found.confidence = 0.75;
  Detections detections;
  detections.items.push_back(found);
  writer.write(frame, detections, {});
  return read_text(folder / name);
}

std::string manifest_bytes() {
  const TemporaryFolder folder;
  Manifest run;
  run.version = "1";
  run.parameters["cast_votes.rotations"] = "60";
  run.models.push_back({1, "part", "part.ply", "0123"});
  run.scans.push_back({0, "scan", {"scan.ply", 1, 0, std::nullopt}});
  run.starts.push_back({{"posevote", "run"}, "/", "host", 1, 1.5, "", 0});
  write_manifest(folder.path(), run);
  return read_text(folder / "run.json");
}

std::filesystem::path folder_of(const std::string& file) {
  return std::filesystem::path(file).parent_path();
}

}  // namespace

std::vector<Reader> config_readers() {
  return {
      file_reader("pipeline", "fuzzed.yaml", read_pipeline,
                  {{"nodes",
                    "models: train\ninputs: [scene_file]\nresult: detections\nnodes:\n"
                    "  load_scene: {in: scene_file, out: [a, b], every: 3}\n"
                    "  seek: {node: load_scene, in: {port: a}, out: detections, radii: [1, 2]}\n",
                    false},
                   {"changes",
                    "extends: base\nremove: [a, b]\nreplace:\n  c: {in: x, out: y}\ninsert:\n"
                    "  d: {after: c, in: y, out: z}\n",
                    false}}),
      file_reader(
          "config", "fuzzed.yaml", [](const std::string& file) { load_configuration(file, {}); },
          {{"parameters",
            "pipeline: recognize\nload_models: {unit: mm}\ncast_votes: {rotations: 30}\n", false}}),
      file_reader("simulation", "fuzzed.yaml", [](const std::string& file) { read_spec(file); },
                  {{"one scene",
                    "seed: 2\nmodels:\n  - {shape: can, seed: 1, x: 0.1, y: 0.1, z: 0.14}\n"
                    "scenes:\n  - {count: 3, sensor: rgbd, objects: [1], clutter: 0}\n",
                    false}}),
      file_reader("sensor", "fuzzed.yaml", [](const std::string& file) { read_sensor(file); },
                  {{"a camera", "width: 848\nheight: 480\nfield: 65\nnoise: 0.0005\n", false}}),
      file_reader("library", "library", read_library, {{"two models", library_bytes()}}),
      file_reader("results_json", "results.json",
                  [](const std::string& file) { read_results(file); },
                  {{"one detection", run_file("results.json"), false}}),
      file_reader("results_csv", "results.csv", [](const std::string& file) { read_results(file); },
                  {{"one detection", run_file("results.csv")}}),
      file_reader("resumed", "results.json",
                  [](const std::string& file) {
                    formats::Batch batch;
                    batch.scans[0].path = "scan.ply";
                    if (formats::resume_results(folder_of(file), batch).damaged > 0)
                      throw std::runtime_error("damaged records");
                  },
                  {{"one detection", run_file("results.json"), false}}),
      file_reader("run_json", "run.json",
                  [](const std::string& file) { read_manifest(folder_of(file)); },
                  {{"one start", manifest_bytes()}})};
}

}  // namespace posevote::test
