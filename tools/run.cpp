// SPDX-License-Identifier: BSD-3-Clause
// `posevote run`: a config, models and scans in; poses out.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "graph/runner.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/formats/results_writer.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "pipelines/overrides.hpp"
#include "tools/commands.hpp"
#include "tools/json_answer.hpp"
#include "tools/run_record.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// Published data sets are in mm; the config and --set may say otherwise.
std::vector<graph::Override> dataset_defaults(const RunCommand& command) {
  if (command.dataset.empty()) return {};
  return {{"load_models", "unit", {"mm", {"--dataset", 0, 0}}},
          {"load_scene", "unit", {"mm", {"--dataset", 0, 0}}}};
}

Configuration read_configuration(const RunCommand& command) {
  std::vector<graph::Override> options = model_overrides(command.model_unit);
  for (graph::Override& change : scene_overrides(command.scene_unit, command.sensor_pose))
    options.push_back(std::move(change));
  return load_configuration(command.config, command.set, dataset_defaults(command),
                            command.pipeline, options);
}

std::vector<SceneEntry> find_scenes(const RunCommand& command) {
  if (command.scenes.empty() == command.dataset.empty())
    throw std::invalid_argument("expected --scenes FILE... or --dataset DIR, one of them");
  return command.dataset.empty() ? list_scenes(command.scenes)
                                 : list_dataset_scenes(command.dataset, command.split);
}

ModelFiles find_models(const RunCommand& command) {
  std::vector<std::string> files = command.models;
  if (files.empty() && !command.dataset.empty())
    files = list_dataset_models(command.dataset, command.split);
  if (files.empty()) throw std::invalid_argument("expected --models FILE... or --library FILE");
  return list_models(files);
}

std::shared_ptr<const ModelLibrary> find_library(const RunCommand& command,
                                                 const Configuration& configuration) {
  if (command.library.empty())
    return cached_library(configuration, find_models(command),
                          command.cache.empty() ? default_cache() : fs::path(command.cache),
                          bad_models(command.on_error));
  if (!command.models.empty())
    throw std::invalid_argument("expected --models FILE... or --library FILE, one of them");
  std::string why_not;
  auto library = library::load_library(command.library, library_key(configuration), why_not);
  if (!library)
    throw std::invalid_argument(command.library + ": " + why_not + "; train it with this config");
  tell_odd_sizes(configuration, *library, {});
  return std::make_shared<const ModelLibrary>(std::move(*library));
}

/// The config that repeats the run, with what else its results depend on as a comment.
std::string describe_run(const RunCommand& command, const Configuration& configuration,
                         const ModelLibrary& library) {
  return "# posevote run --seed " + std::to_string(command.seed) + "; models " +
         library::hash_library(library) + "\n" + effective_yaml(configuration);
}

/// A resumed run must be the same run.
void check_same_run(const fs::path& file, const std::string& text) {
  if (!fs::exists(file)) return;
  std::ifstream old(file, std::ios::binary);
  std::ostringstream before;
  before << old.rdbuf();
  if (before.str() != text)
    throw std::invalid_argument(
        file.string() +
        ": the run to resume had other parameters, models or seed; choose another --out");
}

std::map<std::size_t, fs::path> files_of(const std::vector<SceneEntry>& scenes) {
  std::map<std::size_t, fs::path> files;
  for (const SceneEntry& scene : scenes) files[scene.number] = scene.file.path;
  return files;
}

bool writes_results(const Configuration& configuration) {
  const auto& nodes = configuration.scenes.nodes;
  return std::any_of(nodes.begin(), nodes.end(), [](const graph::PlannedNode& node) {
    return node.spec->name == "write_results";
  });
}

/// Takes away what a run writes, and nothing else that may lie there.
void remove_earlier_run(const fs::path& out) {
  for (const char* file : {"results.csv", "results.json", "failures.json", "effective.yaml",
                           "trace.json", "run.json", "pictures", "overlays", "correspondences"})
    fs::remove_all(out / file);
}

/// Makes the files for the results and leaves out the scans that an earlier run answered.
void begin_run(const RunCommand& command, const Configuration& configuration,
               const ModelLibrary& library, std::vector<SceneEntry>& scenes) {
  if (command.overwrite) remove_earlier_run(command.out);
  if (!writes_results(configuration)) {
    spdlog::warn("{}: no write_results in the pipeline: no results.csv is written",
                 configuration.pipeline);
    return fs::create_directories(command.out), void();
  }
  const std::set<std::size_t> answered =
      formats::begin_results(command.out, command.resume, files_of(scenes), library.left_out);
  std::erase_if(scenes, [&](const SceneEntry& scene) { return answered.contains(scene.number); });
  if (!answered.empty()) spdlog::info("{} frames are answered already", answered.size());
}

/// Tells of the frames as they leave, and writes when each node worked on them.
class Progress {
 public:
  Progress(const RunCommand& command, const Configuration& configuration, std::size_t count)
      : command_(command), count_(count), trace_(node_names(configuration.scenes)) {
    trace_.write_to(fs::path(command.out) / "trace.json");
  }

  void report(const graph::FrameResult<Detections>& result) {
    ++reported_;
    trace_.add(result.context.name, result.spans);
    for (const graph::Warning& warning : result.warnings)
      spdlog::warn("{}: {}: {}", result.context.file.string(), warning.node, warning.what);
    if (result.failure)
      spdlog::error("{}: {}: {}", result.context.file.string(), result.failure->node,
                    result.failure->what);
    else if (!command_.quiet)
      say(result.context, *result.result, graph::cost(result.spans));
  }

  void finish() {
    if (!trace_.close()) spdlog::warn("{}/trace.json could not be written in full", command_.out);
    if (!command_.quiet) std::printf("\n%s", graph::time_table(trace_.times()).c_str());
  }

 private:
  static std::vector<std::string> node_names(const graph::Plan& plan) {
    std::vector<std::string> names;
    for (const graph::PlannedNode& node : plan.nodes) names.push_back(node.name);
    return names;
  }

  /// "0 found" alone explains nothing.
  static void say_nearest(const Detection& best) {
    const auto worst = std::max_element(best.against.begin(), best.against.end());
    std::printf("    the best candidate, %s: %s; most against it: %s\n", best.model.c_str(),
                best.why.c_str(), kClueNames[std::size_t(worst - best.against.begin())]);
  }

  void say(const graph::FrameContext& frame, const Detections& detections, double seconds) const {
    std::printf("[%zu/%zu] %s: %zu found (%.2f s)\n", reported_, count_,
                frame.file.filename().c_str(), detections.items.size(), seconds);
    for (const Detection& item : detections.items)
      std::printf("    %-24s confidence %.2f  inliers %.0f %%  rms %.2f mm\n", item.model.c_str(),
                  item.confidence, 100 * item.inlier_fraction, 1e3 * item.rmse);
    if (detections.items.empty() && !detections.rejected.empty())
      say_nearest(detections.rejected.front());
    std::fflush(stdout);
  }

  const RunCommand& command_;
  const std::size_t count_;
  graph::Trace trace_;
  std::size_t reported_ = 0;
};

graph::RunSummary run_scenes(const RunCommand& command, const Configuration& configuration,
                             const graph::Constants& constants,
                             const std::vector<SceneEntry>& scenes,
                             const std::atomic<bool>& interrupted) {
  Progress progress(command, configuration, scenes.size());
  const auto make_frame = [&](std::size_t i) {
    const SceneEntry& scene = scenes[i];
    return graph::Frame<SceneFile>{
        {scene.number, scene.name, command.out, command.seed, scene.file.path, {}}, {scene.file}};
  };
  const graph::RunSummary summary =
      graph::run(configuration.scenes, constants, graph::counted(scenes.size(), make_frame),
                 {command.tokens, command.on_error == "stop", &interrupted},
                 std::function([&progress](const graph::FrameResult<Detections>& result) {
                   progress.report(result);
                 }));
  progress.finish();
  return summary;
}

int exit_status(const graph::RunSummary& summary, const ModelLibrary& library, bool interrupted) {
  if (interrupted) return 130;
  return summary.failed > 0 || summary.stopped || !library.left_out.empty() ? 1 : 0;
}

}  // namespace

int run_command(const RunCommand& command, const std::atomic<bool>& interrupted) {
  const JsonAnswer answer(command.json);
  const Configuration configuration = read_configuration(command);
  if (configuration.scenes.nodes.empty())
    throw std::invalid_argument(command.config +
                                ": its pipeline has no `models`; expected one that "
                                "finds them in scans, as pipelines/recognize.yaml");
  std::vector<SceneEntry> scenes = take_shard(find_scenes(command), command.shard);
  if (scenes.empty()) throw std::invalid_argument("no scan is left to read in this shard");
  const auto library = as_arguments([&] { return find_library(command, configuration); });
  tell_left_out(*library);
  if (!library->octaves.front().index->reproducible())
    spdlog::warn("the approximate index is built at random: results differ from run to run");

  const graph::Constants constants = constants_of(configuration, library);
  const fs::path effective = fs::path(command.out) / "effective.yaml";
  const std::string description = describe_run(command, configuration, *library);
  if (command.resume) check_same_run(effective, description);
  as_arguments([&] { return begin_run(command, configuration, *library, scenes); });
  // A resumed run has it; a full disk must not take it.
  if (!command.resume || !fs::exists(effective))
    as_arguments([&] { write_text(effective, description); });
  as_arguments([&] {
    record_run(command, command.library.empty() ? find_models(command) : ModelFiles(), *library);
  });
  const graph::RunSummary summary =
      run_scenes(command, configuration, constants, scenes, interrupted);
  std::printf("%zu frames answered, %zu failed; results in %s\n", summary.done, summary.failed,
              command.out.c_str());
  answer.give({{"answered", summary.done}, {"failed", summary.failed}, {"out", command.out}});
  return exit_status(summary, *library, interrupted);
}

}  // namespace posevote
