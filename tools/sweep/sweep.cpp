// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "nodes/data/detections.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/json_answer.hpp"
#include "tools/progress/progress.hpp"
#include "tools/run_lock.hpp"
#include "tools/run_setup.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

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

/// Trained anew only where a setting differs in what training depends on.
SharedStages prepare(const RunCommand& run, const std::vector<Configuration>& configurations,
                     Libraries& libraries) {
  const ModelFiles models = find_models(run);
  std::vector<SharedStages::Variant> variants;
  for (const Configuration& configuration : configurations) {
    auto& library = libraries[training_parameters(configuration.models)];
    if (!library) library = find_library(run, configuration, models);
    const graph::Plan& training = configuration.models;
    const std::string stream = training.streams[std::size_t(training.result)].name;
    variants.push_back({&configuration.scenes, {{stream, library}}});
  }
  return SharedStages(std::move(variants));
}

/// A sweep takes long: its report is taken away only where the command says so.
void check_out(const RunCommand& run) {
  const std::filesystem::path report = std::filesystem::path(run.out) / "sweep.json";
  if (!run.overwrite && std::filesystem::exists(report))
    throw std::invalid_argument(report.string() +
                                ": is there already; choose another --out or say --overwrite");
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

void add(const SharedStages::Outcome& outcome, const SceneEntry& scan, Setting& setting) {
  setting.seconds += outcome.seconds;
  setting.failed += outcome.failure ? 1 : 0;
  if (outcome.failure) return;
  for (const Detection& one : graph::StreamTraits<Detections>::unwrap(outcome.result).items)
    setting.found.push_back({static_cast<int>(setting.found.size()) + 1, scan.file.scene_id,
                             scan.file.im_id, one.obj_id, one.confidence, one.T_scene_model});
}

/// Each failure once, however many settings it is shared by.
void tell_failures(const std::vector<SharedStages::Outcome>& outcomes, const SceneEntry& scan) {
  std::set<std::string> told;
  for (const SharedStages::Outcome& outcome : outcomes)
    if (outcome.failure && told.insert(*outcome.failure).second)
      std::fprintf(stderr, "%s: %s\n", printable(scan.name).c_str(),
                   printable(*outcome.failure).c_str());
}

/// All scans, or those until the interrupt; returns which.
std::set<layouts::ImageKey> search(const RunCommand& run, const std::vector<SceneEntry>& scans,
                                   SharedStages& stages, std::vector<Setting>& settings,
                                   const std::atomic<bool>& interrupted) {
  std::set<layouts::ImageKey> seen;
  Progress progress({"scans", scans.size(), nullptr, !run.quiet, &interrupted});
  progress.note(std::to_string(settings.size()) + " settings each");
  for (const SceneEntry& scan : scans) {
    if (interrupted) break;
    const auto outcomes =
        stages.run({graph::StreamTraits<SceneFile>::wrap(SceneFile(scan.file))},
                   {scan.number, scan.name, {}, run.seed, scan.file.path, {}, {}, {}});
    tell_failures(outcomes, scan);
    for (std::size_t i = 0; i < settings.size(); ++i) add(outcomes[i], scan, settings[i]);
    seen.insert({scan.file.scene_id, scan.file.im_id});
    progress.advance();
  }
  return seen;
}

/// The counts of each image, in the order of their keys.
std::vector<Counts> split_by_image(const Evaluation& evaluation, std::size_t rule,
                                   const std::vector<FoundInstance>& found,
                                   const std::set<layouts::ImageKey>& images) {
  std::map<layouts::ImageKey, Counts> counts;
  for (const layouts::ImageKey& key : images) counts[key];
  for (const InstanceResult& instance : evaluation.instances) {
    if (!instance.counted || std::isnan(instance.met[rule])) continue;
    Counts& image = counts.at({instance.scene_id, instance.im_id});
    ++image.instances;
    image.correct += instance.met[rule];
  }
  for (const Verdict& verdict : evaluation.all[rule].verdicts) {
    const FoundInstance& one = found.at(static_cast<std::size_t>(verdict.line - 1));
    counts.at({one.scene_id, one.im_id}).detections +=
        verdict.score >= evaluation.options.min_score;
  }
  std::vector<Counts> list;
  for (const auto& [key, image] : counts) list.push_back(image);
  return list;
}

std::vector<Judged> judge(const layouts::GroundTruth& truth, const EvaluateOptions& options,
                          const std::vector<Setting>& settings,
                          const std::set<layouts::ImageKey>& images, std::uint64_t seed) {
  const std::vector<Rule> rules = choose_rules(options.rules);
  std::vector<std::vector<std::vector<Counts>>> counts(rules.size());  // by setting, image
  for (const Setting& setting : settings) {
    const Evaluation evaluation = evaluate(truth, setting.found, options);
    for (std::size_t r = 0; r < rules.size(); ++r)
      counts[r].push_back(split_by_image(evaluation, r, setting.found, images));
  }
  std::vector<Judged> judged;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    Judged& rule = judged.emplace_back(Judged{rules[r], {}, {}, 0});
    const Figure figure = figure_of(rules[r]);
    for (const auto& of_images : counts[r]) rule.counts.push_back(total_of(of_images));
    const auto best = std::max_element(
        rule.counts.begin(), rule.counts.end(),
        [&](const Counts& a, const Counts& b) { return (a.*figure)() < (b.*figure)(); });
    rule.best = static_cast<std::size_t>(best - rule.counts.begin());
    rule.certainty = bootstrap(counts[r], rule.best, figure, seed);
  }
  return judged;
}

int exit_status(const Sweep& sweep, const Libraries& libraries, bool interrupted) {
  if (interrupted) return 130;
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
  Libraries libraries;
  SharedStages stages =
      as_arguments([&] { return prepare(command.run, configurations, libraries); });
  for (const auto& [parameters, library] : libraries) tell_left_out(*library);
  check_differ(sweep.axes, values, stages);
  const RunLock lock(command.run.out);
  for (const Values& each : values) sweep.settings.push_back({each, {}, 0, 0});
  const auto seen = search(command.run, scans, stages, sweep.settings, interrupted);
  if (seen.empty()) return 130;  // interrupted before there was anything to say
  std::erase_if(truth.instances, [&](const layouts::TrueInstance& instance) {
    return !seen.contains({instance.scene_id, instance.im_id});
  });
  sweep.images = seen.size();
  sweep.calls = stages.calls();
  sweep.rules = judge(truth, command.judge, sweep.settings, seen, command.run.seed);
  std::printf("%s", to_text(sweep).c_str());
  const nlohmann::ordered_json json = to_json(sweep);
  write_report(std::filesystem::path(command.run.out) / "sweep", json.dump(1) + "\n",
               to_csv(rows_of(sweep)), to_svg(sweep));
  answer.give(json);
  return exit_status(sweep, libraries, interrupted);
}

}  // namespace posevote
