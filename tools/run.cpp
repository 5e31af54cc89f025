// SPDX-License-Identifier: BSD-3-Clause
// `posevote run`: a config, models and scans in; poses out.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "graph/runner.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/library/library_file.hpp"
#include "nodes/write/results_writer.hpp"
#include "tools/commands.hpp"
#include "tools/inputs.hpp"
#include "tools/library.hpp"
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
                          command.cache.empty() ? default_cache() : fs::path(command.cache));
  if (!command.models.empty())
    throw std::invalid_argument("expected --models FILE... or --library FILE, one of them");
  std::string why_not;
  auto library = library::load_library(command.library, library_key(configuration), why_not);
  if (!library)
    throw std::invalid_argument(command.library + ": " + why_not + "; train it with this config");
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

std::string nodes_json(const std::vector<graph::NodeTimes>& times) {
  double sum = 0;
  for (const graph::NodeTimes& node : times) sum += node.total;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const graph::NodeTimes& node : times)
    list.push_back({{"node", node.node},
                    {"calls", node.calls},
                    {"total_s", node.total},
                    {"mean_s", node.mean()},
                    {"max_s", node.max},
                    {"share", sum > 0 ? node.total / sum : 0}});
  return list.dump();
}

/// Receives the frames in order, writes them and tells of them.
class Reporter {
 public:
  Reporter(const RunCommand& command, const Configuration& configuration,
           std::vector<SceneEntry> scenes)
      : command_(command),
        configuration_(configuration),
        scenes_(std::move(scenes)),
        writer_(command.out, command.resume, files_of(scenes_)),
        trace_(node_names(configuration.scenes)) {
    std::erase_if(scenes_, [this](const SceneEntry& scene) {
      return writer_.answered().contains(scene.number);
    });
    if (!writer_.answered().empty())
      spdlog::info("{} frames are answered already", writer_.answered().size());
    trace_.write_to(fs::path(command.out) / "trace.json");
  }

  std::size_t count() const { return scenes_.size(); }

  graph::Frame<SceneFile> make_frame(std::size_t i) const {
    const SceneEntry& scene = scenes_[i];
    return {{scene.number, scene.name, fs::path(command_.out), command_.seed}, {scene.file}};
  }

  void report(const graph::FrameResult<Detections>& result) {
    const SceneEntry& scene = scenes_[reported_++];
    trace_.add(scene.name, result.spans);
    if (result.failure) {
      writer_.write({scene.number, scene.file.path, result.failure->node, result.failure->what});
      spdlog::error("{}: {}: {}", scene.file.path.string(), result.failure->node,
                    result.failure->what);
      return;
    }
    const write::FrameReport frame = frame_report(scene, result.spans);
    writer_.write(frame, *result.result, nodes_json(trace_.times()));
    if (!command_.quiet) say(frame, *result.result);
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

  write::FrameReport frame_report(const SceneEntry& scene,
                                  const std::vector<graph::Span>& spans) const {
    write::FrameReport report{scene.number, scene.file, 0, {}, scene.name};
    double begin = 0;
    double end = 0;
    for (std::size_t i = 0; i < spans.size(); ++i) {
      if (!spans[i].ran()) continue;
      begin = report.stages.empty() ? spans[i].begin : std::min(begin, spans[i].begin);
      end = std::max(end, spans[i].end);
      report.stages[configuration_.scenes.nodes[i].name] = spans[i].seconds();
    }
    report.seconds = (end - begin) * 1e-6;
    return report;
  }

  void say(const write::FrameReport& frame, const Detections& detections) const {
    std::printf("[%zu/%zu] %s: %zu found (%.2f s)\n", reported_, scenes_.size(),
                frame.file.path.filename().c_str(), detections.items.size(), frame.seconds);
    for (const Detection& item : detections.items)
      std::printf("    %-24s score %.2f  density %.0f (next %.0f)  inliers %.0f %%  rms %.2f mm\n",
                  item.model.c_str(), item.score, item.density, item.runner_up_density,
                  100 * item.inlier_fraction, 1e3 * item.rmse);
    std::fflush(stdout);
  }

  const RunCommand& command_;
  const Configuration& configuration_;
  std::vector<SceneEntry> scenes_;
  write::ResultsWriter writer_;
  graph::Trace trace_;
  std::size_t reported_ = 0;
};

int exit_status(const graph::RunSummary& summary, bool interrupted) {
  if (interrupted) return 130;
  return summary.failed > 0 || summary.stopped ? 1 : 0;
}

}  // namespace

int run_command(const RunCommand& command, const std::atomic<bool>& interrupted) {
  const Configuration configuration =
      load_configuration(command.config, command.set, dataset_defaults(command), command.pipeline);
  if (configuration.scenes.nodes.empty())
    throw std::invalid_argument(command.config +
                                ": its pipeline has no `models`; expected one that "
                                "finds them in scans, as pipelines/recognize.yaml");
  std::vector<SceneEntry> scenes = take_shard(find_scenes(command), command.shard);
  if (scenes.empty()) throw std::invalid_argument("no scan is left to read in this shard");
  const auto library = as_arguments([&] { return find_library(command, configuration); });
  if (!library->index->reproducible())
    spdlog::warn("the approximate index is built at random: results differ from run to run");

  const graph::Constants constants = constants_of(configuration, library);
  const fs::path effective = fs::path(command.out) / "effective.yaml";
  const std::string description = describe_run(command, configuration, *library);
  if (command.resume) check_same_run(effective, description);
  Reporter reporter =
      as_arguments([&] { return Reporter(command, configuration, std::move(scenes)); });
  // A resumed run has it; a full disk must not take it.
  if (!command.resume || !fs::exists(effective))
    as_arguments([&] { write_text(effective, description); });
  const graph::RunOptions options{command.tokens, command.on_error == "stop", &interrupted};
  const auto make_frame = [&reporter](std::size_t i) { return reporter.make_frame(i); };
  const graph::RunSummary summary =
      graph::run(configuration.scenes, constants, graph::counted(reporter.count(), make_frame),
                 options, std::function([&reporter](const graph::FrameResult<Detections>& result) {
                   reporter.report(result);
                 }));
  reporter.finish();
  std::printf("%zu frames answered, %zu failed; results in %s\n", summary.done, summary.failed,
              command.out.c_str());
  return exit_status(summary, interrupted);
}

}  // namespace posevote
