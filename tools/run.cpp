// SPDX-License-Identifier: BSD-3-Clause
// `posevote run`: a config, models and scans in; poses out.
#include <spdlog/spdlog.h>

#include <iostream>
#include <stdexcept>

#include "graph/runner.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/formats/scan_hash.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/command_line.hpp"
#include "tools/commands.hpp"
#include "tools/heap.hpp"
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

graph::RunSummary run_scenes(const RunCommand& command, const StreamOptions& options,
                             const Configuration& configuration, const graph::Constants& constants,
                             stream::Scans& scans, const std::atomic<bool>& interrupted,
                             std::size_t& found) {
  const ReadyHeap heap;
  graph::Activity activity;
  stream::ScanSizes sizes;
  FrameReport report(command, configuration.scenes, scans.count(), activity, interrupted);
  const auto next_frame = [&]() -> std::optional<graph::Frame<SceneFile>> {
    std::optional<stream::TakenScan> taken = scans.next();
    if (!taken) return std::nullopt;
    auto& [number, name, file] = taken->entry;
    file.hash = formats::hash_or_unknown(file);  // one that cannot be read fails as a frame
    return graph::Frame<SceneFile>{{number, name, command.out, command.seed, file.path},
                                   {file},
                                   sizes.expected(file),
                                   taken->since};
  };
  const graph::RunSummary summary =
      graph::run(configuration.scenes, constants, next_frame,
                 {command.tokens, command.on_error == "stop", &interrupted, &activity,
                  stream::memory_limit(options.memory)},
                 std::function([&](const graph::FrameResult<Detections>& result) {
                   report.add(result);
                   scans.answered(*result.since);
                 }));
  report.finish();
  found = report.found();
  return summary;
}

/// Null where the scans are listed.
std::unique_ptr<stream::Scans> follow_scans(const RunCommand& command, const StreamOptions& options,
                                            const std::atomic<bool>& interrupted) {
  if (!options.follow) return nullptr;
  if (command.scenes.size() != 1)
    throw std::runtime_error("--follow expects --scenes FOLDER, one of them");
  return std::make_unique<stream::FollowedScans>(command.scenes[0], options.real_time, interrupted);
}

/// An experiment goes on by itself.
void tell_left(const RunCommand& command, std::size_t all, const graph::RunSummary& summary) {
  const std::size_t left = all - summary.done - summary.failed;
  tell_interrupted(std::to_string(left) + " of " + std::to_string(all) + " frames are left" +
                       (summary.failed > 0 ? ", and those that failed" : ""),
                   command.lines);
}

int exit_status(const graph::RunSummary& summary, const ModelLibrary& library, bool interrupted) {
  if (interrupted) return 130;
  return summary.failed > 0 || summary.stopped || !library.left_out.empty() ? 1 : 0;
}

/// What scans are searched for.
struct Sought {
  ModelFiles files;
  std::shared_ptr<const ModelLibrary> library;
  graph::Constants constants;
};

/// Nothing where the user has had enough meanwhile.
std::optional<Sought> prepare(const RunCommand& command, const Configuration& configuration,
                              const std::atomic<bool>& interrupted) try {
  Sought sought{find_models(command), nullptr, {}};
  sought.library =
      as_arguments([&] { return find_library(command, configuration, sought.files, interrupted); });
  tell_left_out(*sought.library);
  if (!sought.library->octaves.front().index->reproducible())
    spdlog::warn("the approximate index is built at random: results differ from run to run");
  graph::Activity activity(&interrupted);
  const Progress progress({"preparing the search", 0, &activity, !command.quiet});
  sought.constants = constants_of(configuration, sought.library, &activity);
  return sought;
} catch (const graph::Cancelled&) {
  return std::nullopt;
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
  const std::optional<Sought> sought = prepare(command, configuration, interrupted);
  if (!sought) {
    if (!options.follow) tell_left(command, scenes.size(), {});
    return 130;
  }
  const auto lock = as_arguments([&] { return RunLock(command.out); });
  as_arguments([&] {
    begin_run(command, configuration, *sought->library,
              describe_run(command, configuration, sought->files, *sought->library, all), scenes);
  });
  std::size_t found = 0;
  if (!scans) scans = std::make_unique<stream::ListedScans>(std::move(scenes));
  const graph::RunSummary summary =
      run_scenes(command, options, configuration, sought->constants, *scans, interrupted, found);
  finish_run(command, configuration);
  if (!command.quiet && !scans->text().empty()) std::cout << scans->text() << "\n";
  std::cout << summary.done << " frames answered, " << summary.failed << " failed; " << found
            << " found; results in " << printable(command.out) << "\n"
            << std::flush;
  if (interrupted && !options.follow) tell_left(command, scans->count(), summary);
  answer.give({{"answered", summary.done},
               {"failed", summary.failed},
               {"found", found},
               {"stream", scans->json()},
               {"out", command.out}});
  return exit_status(summary, *sought->library, interrupted);
}

}  // namespace posevote
