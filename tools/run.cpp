// SPDX-License-Identifier: BSD-3-Clause
// `posevote run`: a config, models and scans in; poses out.
#include <spdlog/spdlog.h>

#include <iostream>
#include <stdexcept>
#include <thread>

#include "graph/runner.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/command_line.hpp"
#include "tools/commands.hpp"
#include "tools/json_answer.hpp"
#include "tools/manifest/run_folder.hpp"
#include "tools/progress/frame_report.hpp"
#include "tools/run_lock.hpp"
#include "tools/run_setup.hpp"
#include "tools/stream/followed_scans.hpp"
#include "tools/stream/memory.hpp"
#include "tools/stream/run_stream.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

std::vector<SceneEntry> find_scenes(const RunCommand& command, const StreamOptions& options) {
  if (options.follow) return {};
  if (command.scenes.empty() == command.dataset.empty())
    throw std::invalid_argument("expected --scenes FILE... or --dataset DIR, one of them");
  return command.dataset.empty() ? list_scenes(command.scenes)
                                 : list_dataset_scenes(command.dataset, command.split);
}

graph::RunSummary run_scenes(const RunCommand& command, const Configuration& configuration,
                             const graph::Constants& constants, stream::Scans& scans,
                             std::size_t tokens, const std::atomic<bool>& interrupted,
                             std::size_t& found) {
  graph::Activity activity;
  FrameReport report(command, configuration.scenes, scans.count(), activity, interrupted);
  const auto next_frame = [&]() -> std::optional<graph::Frame<SceneFile>> {
    const std::optional<SceneEntry> scene = scans.next();
    if (!scene) return std::nullopt;
    return graph::Frame<SceneFile>{
        {scene->number, scene->name, command.out, command.seed, scene->file.path, {}},
        {scene->file}};
  };
  const graph::RunSummary summary =
      graph::run(configuration.scenes, constants, next_frame,
                 {tokens, command.on_error == "stop", &interrupted, &activity},
                 std::function([&](const graph::FrameResult<Detections>& result) {
                   report.add(result);
                   scans.answered(result.context.number);
                 }));
  report.finish();
  found = report.found();
  return summary;
}

/// Frames in flight.
std::size_t tokens_of(const RunCommand& command, const StreamOptions& options,
                      const std::vector<SceneEntry>& scenes) {
  const std::size_t threads =
      command.threads > 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency());
  return stream::tokens_within(stream::memory_limit(options.memory),
                               command.tokens > 0 ? command.tokens : 2 * threads, scenes);
}

/// Null where the scans are listed.
std::unique_ptr<stream::Scans> follow_scans(const RunCommand& command, const StreamOptions& options,
                                            const std::atomic<bool>& interrupted) {
  if (!options.follow) return nullptr;
  if (command.scenes.size() != 1)
    throw std::runtime_error("--follow expects --scenes FOLDER, one of them");
  return std::make_unique<stream::FollowedScans>(command.scenes[0], options.real_time, interrupted);
}

/// How many are left, and the command that goes on: an experiment does so by itself.
void tell_interrupted(const RunCommand& command, std::size_t all,
                      const graph::RunSummary& summary) {
  const std::size_t left = all - summary.done - summary.failed;
  std::cerr << "interrupted: " << left << " of " << all << " frames are left"
            << (summary.failed > 0 ? ", and those that failed" : "") << "; to go on:\n  "
            << resuming_command(command.lines) << "\n";
}

int exit_status(const graph::RunSummary& summary, const ModelLibrary& library, bool interrupted) {
  if (interrupted) return 130;
  return summary.failed > 0 || summary.stopped || !library.left_out.empty() ? 1 : 0;
}

}  // namespace

int run_command(const RunCommand& command, const std::atomic<bool>& interrupted) {
  return run_command(command, {}, interrupted);
}

int run_command(const RunCommand& command, const StreamOptions& options,
                const std::atomic<bool>& interrupted) {
  const JsonAnswer answer(command.json);
  const Configuration configuration = read_configuration(command);
  if (configuration.scenes.nodes.empty())
    throw std::invalid_argument(command.config +
                                ": its pipeline has no `models`; expected one that "
                                "finds them in scans, as pipelines/recognize.yaml");
  const std::vector<SceneEntry> all = find_scenes(command, options);
  std::vector<SceneEntry> scenes = take_shard(all, command.shard);
  auto scans = as_arguments([&] { return follow_scans(command, options, interrupted); });
  if (scenes.empty() && !scans)
    throw std::invalid_argument("no scan is left to read in this shard");
  const ModelFiles models = find_models(command);
  const auto library = as_arguments([&] { return find_library(command, configuration, models); });
  tell_left_out(*library);
  if (!library->octaves.front().index->reproducible())
    spdlog::warn("the approximate index is built at random: results differ from run to run");

  const graph::Constants constants = [&] {
    const Progress progress({"preparing the search", 0, nullptr, !command.quiet});
    return constants_of(configuration, library);
  }();
  const auto lock = as_arguments([&] { return RunLock(command.out); });
  as_arguments([&] {
    begin_run(command, configuration, *library,
              describe_run(command, configuration, models, *library, all), scenes);
  });
  std::size_t found = 0;
  const std::size_t tokens = tokens_of(command, options, scenes);
  if (!scans) scans = std::make_unique<stream::ListedScans>(std::move(scenes));
  const graph::RunSummary summary =
      run_scenes(command, configuration, constants, *scans, tokens, interrupted, found);
  finish_run(command, configuration);
  if (!command.quiet && !scans->text().empty()) std::cout << scans->text() << "\n";
  std::cout << summary.done << " frames answered, " << summary.failed << " failed; " << found
            << " found; results in " << printable(command.out) << "\n"
            << std::flush;
  if (interrupted && !options.follow) tell_interrupted(command, scans->count(), summary);
  answer.give({{"answered", summary.done},
               {"failed", summary.failed},
               {"found", found},
               {"stream", scans->json()},
               {"out", command.out}});
  return exit_status(summary, *library, interrupted);
}

}  // namespace posevote
