// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/sweep.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "nodes/data/detections.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/command_line.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/json_answer.hpp"
#include "tools/manifest/manifest.hpp"
#include "tools/progress/progress.hpp"
#include "tools/run_lock.hpp"
#include "tools/run_setup.hpp"
#include "tools/sweep/journal.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using namespace sweep;
using Libraries = std::map<std::string, std::shared_ptr<const ModelLibrary>>;

/// One for each setting. Throws graph::ConfigError with every problem, each once.
std::vector<Configuration> configure(const RunCommand& run, const std::vector<Axis>& axes,
                                     const std::vector<Values>& settings) {
  std::vector<Configuration> configurations;
  std::vector<graph::Problem> problems;
  std::set<std::string> known;
  for (const Values& values : settings) try {
      configurations.push_back(read_configuration(run, overrides_of(axes, values)));
    } catch (const graph::ConfigError& error) {
      for (const graph::Problem& problem : error.problems())
        if (known.insert(graph::to_string(problem)).second) problems.push_back(problem);
    }
  if (!problems.empty()) throw graph::ConfigError(std::move(problems));
  if (configurations.front().scenes.nodes.empty())
    throw std::invalid_argument(run.config + ": its pipeline has no `models`; expected one that " +
                                "finds them in scans, as pipelines/recognize.yaml");
  return configurations;
}

/// Trained anew only where a setting differs in what training depends on; nothing where it is
/// interrupted.
std::optional<SharedStages> prepare(const RunCommand& run,
                                    const std::vector<Configuration>& configurations,
                                    const ModelFiles& models, const std::atomic<bool>& interrupted,
                                    Libraries& libraries) try {
  std::vector<SharedStages::Variant> variants;
  for (const Configuration& configuration : configurations) {
    auto& library = libraries[training_parameters(configuration.models)];
    if (!library) library = find_library(run, configuration, models, interrupted);
    const graph::Plan& training = configuration.models;
    const std::string stream = training.streams[std::size_t(training.result)].name;
    variants.push_back({&configuration.scenes, {{stream, library}}});
  }
  return SharedStages(std::move(variants));
} catch (const graph::Cancelled&) {
  return std::nullopt;
}

/// A sweep takes long: what it wrote is taken away only where the command says so.
void check_out(const RunCommand& run) {
  if (run.overwrite || run.resume) return;
  for (const char* file : {"sweep.json", "scans.json", "run.json"})
    if (const fs::path there = fs::path(run.out) / file; fs::exists(there))
      throw std::invalid_argument(there.string() +
                                  ": is there already; choose another --out, or "
                                  "say --resume or --overwrite");
}

/// What is varied is named in the order of the command line, as the settings are.
Manifest describe_sweep(const SweepCommand& command, const std::vector<Configuration>& settings,
                        const ModelFiles& models, const Libraries& libraries,
                        const std::vector<Axis>& axes, const std::vector<SceneEntry>& scans) {
  Manifest sweep =
      describe_run(command.run, settings.front(), models, *libraries.begin()->second, scans);
  std::string& vary = sweep.parameters["--vary"];
  for (const Axis& axis : axes) {
    sweep.parameters.erase(axis.name());
    vary += (vary.empty() ? "" : " ") + axis.name() + "=" + graph::join_list(axis.values);
  }
  sweep.library_hash.clear();
  for (const auto& [parameters, library] : libraries)
    sweep.library_hash += library::hash_library(*library);
  return sweep;
}

/// Throws what Journal does, and std::invalid_argument where the one to resume is of another sweep.
Journal begin(const RunCommand& run, Manifest sweep, const std::vector<SceneEntry>& scans) {
  if (run.resume) take_up(run.out, sweep);
  Journal journal(run.out, run.resume, scans);
  sweep.starts.back().answered = journal.count();
  write_manifest(run.out, sweep);
  return journal;
}

/// Settings that cannot differ are a mistake: equal values, or a node that only writes.
void check_differ(const std::vector<Axis>& axes, const std::vector<Values>& settings,
                  const SharedStages& stages) {
  std::map<std::size_t, std::size_t> first;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto [place, is_new] = first.emplace(stages.answer_of(i), i);
    if (!is_new)
      throw std::invalid_argument(
          "--vary: " + to_text(axes, settings[place->second]) + " and " +
          to_text(axes, settings[i]) +
          " find the same in every scan; expected values that differ, of a node that answers "
          "depend on");
  }
}

/// The scans whose true poses are known.
std::vector<SceneEntry> find_scans(const SweepCommand& command, const layouts::GroundTruth& truth) {
  std::vector<SceneEntry> scans =
      take_shard(list_dataset_scenes(command.run.dataset, command.run.split),
                 "1/" + std::to_string(command.every));
  std::erase_if(scans, [&](const SceneEntry& scan) {
    return !truth.images.contains({scan.file.scene_id, scan.file.im_id});
  });
  if (scans.empty() || truth.instances.empty())
    throw std::invalid_argument(command.run.dataset + ": no scan of split '" + command.run.split +
                                "' has true poses");
  return scans;
}

Answer answer_of(const SharedStages::Outcome& outcome) {
  Answer answer{outcome.seconds, outcome.failure, {}};
  if (outcome.failure) return answer;
  for (const Detection& one : graph::StreamTraits<Detections>::unwrap(outcome.result).items)
    answer.found.push_back({one.obj_id, one.confidence, one.T_scene_model});
  return answer;
}

ScanAnswers search(const RunCommand& run, const SceneEntry& scan, SharedStages& stages) {
  ScanAnswers answers;
  for (const SharedStages::Outcome& outcome :
       stages.run({graph::StreamTraits<SceneFile>::wrap(SceneFile(scan.file))},
                  {scan.number, scan.name, {}, run.seed, scan.file.path}))
    answers.settings.push_back(answer_of(outcome));
  answers.calls = stages.take_calls();
  return answers;
}

/// Each failure once, however many settings it is shared by.
void tell_failures(const ScanAnswers& answers, const SceneEntry& scan) {
  std::set<std::string> told;
  for (const Answer& answer : answers.settings)
    if (answer.failure && told.insert(*answer.failure).second)
      std::fprintf(stderr, "%s: %s\n", printable(scan.name).c_str(),
                   printable(*answer.failure).c_str());
}

void add(const Answer& answer, const SceneEntry& scan, Setting& setting) {
  setting.seconds += answer.seconds;
  setting.failed += answer.failure ? 1 : 0;
  for (const Answer::Pose& pose : answer.found)
    setting.found.push_back({static_cast<int>(setting.found.size()) + 1, scan.file.scene_id,
                             scan.file.im_id, pose.obj_id, pose.score, pose.T_scene_model});
}

void add(const SharedStages::AllCalls& calls, SharedStages::AllCalls& sum) {
  for (const auto& [node, more] : calls) {
    sum[node].asked += more.asked;
    sum[node].made += more.made;
  }
}

/// All scans, or those until the interrupt; returns which.
std::set<layouts::ImageKey> search(const RunCommand& run, const std::vector<SceneEntry>& scans,
                                   SharedStages& stages, Journal& journal, Sweep& sweep,
                                   const std::atomic<bool>& interrupted) {
  std::set<layouts::ImageKey> seen;
  Progress progress({"scans", scans.size(), nullptr, !run.quiet, &interrupted});
  progress.note(std::to_string(sweep.settings.size()) + " settings each");
  for (const SceneEntry& scan : scans) {
    const ScanAnswers* answers = journal.find(scan.number);
    if (!answers && interrupted) continue;
    if (!answers) answers = &journal.add(scan, search(run, scan, stages));
    tell_failures(*answers, scan);
    for (std::size_t i = 0; i < sweep.settings.size(); ++i)
      add(answers->settings.at(i), scan, sweep.settings[i]);
    add(answers->calls, sweep.calls);
    seen.insert({scan.file.scene_id, scan.file.im_id});
    progress.advance();
  }
  return seen;
}

int interrupted_status(std::size_t left, std::size_t all) {
  tell_interrupted(std::to_string(left) + " of " + std::to_string(all) + " scans are left", true);
  return 130;
}

int exit_status(const Sweep& sweep, const Libraries& libraries) {
  const bool failed = std::any_of(sweep.settings.begin(), sweep.settings.end(),
                                  [](const Setting& setting) { return setting.failed > 0; });
  const bool left_out = std::any_of(libraries.begin(), libraries.end(), [](const auto& library) {
    return !library.second->left_out.empty();
  });
  return failed || left_out ? 1 : 0;
}

}  // namespace

int sweep_command(const SweepCommand& command, const std::atomic<bool>& interrupted) {
  const JsonAnswer answer(command.run.json);
  choose_rules(command.judge.rules);  // typing mistakes show before anything is read
  check_out(command.run);
  Sweep sweep;
  sweep.axes = read_axes(command.vary);
  const std::vector<Values> values = combine(sweep.axes);
  const std::vector<Configuration> configurations = configure(command.run, sweep.axes, values);
  layouts::GroundTruth truth = as_arguments([&] {
    return layouts::read_ground_truth(command.run.dataset, command.run.split, command.targets);
  });
  const std::vector<SceneEntry> scans = find_scans(command, truth);
  const ModelFiles models = find_models(command.run);
  Libraries libraries;
  std::optional<SharedStages> stages = as_arguments(
      [&] { return prepare(command.run, configurations, models, interrupted, libraries); });
  if (!stages) return interrupted_status(scans.size(), scans.size());
  for (const auto& [parameters, library] : libraries) tell_left_out(*library);
  check_differ(sweep.axes, values, *stages);
  const auto lock = as_arguments([&] { return RunLock(command.run.out); });
  Journal journal = as_arguments([&] {
    return begin(command.run,
                 describe_sweep(command, configurations, models, libraries, sweep.axes, scans),
                 scans);
  });
  for (const Values& each : values) sweep.settings.push_back({each, {}, 0, 0});
  sweep.calls = stages->take_calls();
  const auto seen = search(command.run, scans, *stages, journal, sweep, interrupted);
  if (seen.empty()) return interrupted_status(scans.size(), scans.size());
  std::erase_if(truth.instances, [&](const layouts::TrueInstance& instance) {
    return !seen.contains({instance.scene_id, instance.im_id});
  });
  sweep.images = seen.size();
  sweep.rules = judge(truth, command.judge, sweep.settings, seen, command.run.seed);
  std::printf("%s", to_text(sweep).c_str());
  const nlohmann::ordered_json json = to_json(sweep);
  write_report(fs::path(command.run.out) / "sweep", json.dump(1) + "\n", to_csv(rows_of(sweep)),
               to_svg(sweep));
  answer.give(json);
  if (interrupted) return interrupted_status(scans.size() - seen.size(), scans.size());
  return exit_status(sweep, libraries);
}

}  // namespace posevote
