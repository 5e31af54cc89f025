// SPDX-License-Identifier: BSD-3-Clause
#include "tools/manifest/run_folder.hpp"

#include <spdlog/spdlog.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "graph/wiring.hpp"
#include "graph/write_file.hpp"
#include "nodes/formats/results_files.hpp"
#include "tools/progress/progress.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// The config that repeats the run, with what else its results depend on as a comment.
std::string effective_text(const Manifest& run, const Configuration& configuration) {
  return "# posevote run --seed " + std::to_string(run.seed) + "; models " + run.library_hash +
         "\n" + effective_yaml(configuration);
}

void write_if_changed(const fs::path& file, const std::string& text) {
  std::ifstream old(file, std::ios::binary);
  std::ostringstream before;
  before << old.rdbuf();
  if (before.str() != text) graph::write_durably(file, text);
}

/// The formats of write_results; empty-handed where the pipeline has no such node.
std::optional<std::vector<std::string>> result_formats(const Configuration& configuration) {
  const graph::PlannedNode* node = graph::find_type(configuration.scenes, "write_results");
  if (!node) return std::nullopt;
  return graph::split_list(graph::value_of(*node, "format"));
}

/// Goes on with the run in --out: what it has answered is left out of `scenes`.
void resume_run(const RunCommand& command, const formats::Batch& batch, Manifest& manifest,
                std::vector<SceneEntry>& scenes) {
  take_up(command.out, manifest);
  const formats::Answered answered = [&] {
    const Progress progress({"comparing the scans", 0, nullptr, !command.quiet});
    return formats::resume_results(command.out, batch);
  }();
  std::erase_if(scenes,
                [&](const SceneEntry& scene) { return answered.frames.contains(scene.number); });
  manifest.starts.back().answered = answered.frames.size();
  if (!answered.frames.empty())
    spdlog::info("{} frames are answered already", answered.frames.size());
  if (answered.damaged > 0)
    spdlog::warn("{}/results.json: {} damaged records are left out; their frames are done again",
                 command.out, answered.damaged);
}

}  // namespace

void remove_run(const fs::path& out) {
  for (const char* file : {"results.csv", "results.json", "detections.csv", "failures.json",
                           "effective.yaml", "trace.json", "run.json"})
    fs::remove_all(out / file);
  for (const char* folder : kFoldersOfFrames) fs::remove_all(out / folder);
}

void begin_run(const RunCommand& command, const Configuration& configuration,
               const ModelLibrary& library, Manifest manifest, std::vector<SceneEntry>& scenes) {
  if (command.overwrite) remove_run(command.out);
  graph::remove_unfinished(command.out);
  for (const char* folder : kFoldersOfFrames)
    graph::remove_unfinished(fs::path(command.out) / folder);
  if (const auto formats = result_formats(configuration)) {
    formats::Batch batch{{}, {}, library.left_out, *formats};
    for (const SceneEntry& scene : manifest.scans) batch.scans[scene.number] = scene.file;
    for (const SceneEntry& scene : scenes) batch.mine.insert(scene.number);
    if (command.resume)
      resume_run(command, batch, manifest, scenes);
    else
      formats::begin_results(command.out, batch);
  } else {
    spdlog::warn("{}: no write_results in the pipeline: no results are written",
                 configuration.pipeline);
  }
  write_manifest(command.out, manifest);
  write_if_changed(fs::path(command.out) / "effective.yaml",
                   effective_text(manifest, configuration));
}

void finish_run(const RunCommand& command, const Configuration& configuration) try {
  if (const auto formats = result_formats(configuration))
    formats::finish_results(command.out, *formats);
} catch (const std::runtime_error& error) {
  spdlog::warn("{}; the results are whole, but not in the order of the scans", error.what());
}

}  // namespace posevote
