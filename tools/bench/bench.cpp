// SPDX-License-Identifier: BSD-3-Clause
// Methods take turns, so that a machine that slows down slows all of them; figures are medians.
#include "tools/bench/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "graph/runner.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/inputs.hpp"
#include "tools/library.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

using Samples = std::vector<double>;

constexpr const char* kLoading = "load_scene";

/// One method, ready to run, and what was measured of it.
struct Contestant {
  Method method;
  Configuration configuration;
  std::map<std::string, graph::Value> constants;
  Samples training, online;  ///< [s]; online: a scan, loading aside
  std::vector<Samples> stages;
};

double median(Samples samples) {
  if (samples.empty()) return 0;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// Writers would measure the disk.
std::vector<std::string> without_writers(const BenchCommand& command, const Method& method) {
  std::vector<std::string> sets = method.set;
  sets.insert(sets.end(), command.set.begin(), command.set.end());
  const graph::Plan plan = load_configuration(command.config, sets, {}, method.pipeline).scenes;
  for (const graph::PlannedNode& node : plan.nodes)
    for (const graph::ParamSpec& param : node.spec->params)
      if (node.output < 0 && param.name == "every") sets.push_back(node.name + ".every=0");
  return sets;
}

void train_once(Contestant& contestant, const ModelFiles& models) {
  const auto begin = std::chrono::steady_clock::now();
  const graph::Value library = train(contestant.configuration, models);
  const graph::Plan& plan = contestant.configuration.models;
  contestant.constants = graph::fold_constants(
      contestant.configuration.scenes, {{plan.streams[std::size_t(plan.result)].name, library}});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  contestant.training.push_back(seconds.count());
}

void run_once(Contestant& contestant, const SceneEntry& scene) {
  const graph::Plan& plan = contestant.configuration.scenes;
  const graph::FrameResult result = graph::run_one(
      plan, contestant.constants,
      {{scene.number, scene.name, {}, 0}, {std::make_shared<const SceneFile>(scene.file)}});
  if (result.failure)
    throw std::runtime_error(scene.file.path.string() + ": " + result.failure->node + ": " +
                             result.failure->what);
  double begin = 0, end = 0;
  bool first = true;
  for (std::size_t i = 0; i < result.spans.size(); ++i) {
    const graph::Span& span = result.spans[i];
    if (!span.ran()) continue;
    contestant.stages[i].push_back(span.seconds());
    if (plan.nodes[i].name == kLoading) continue;
    begin = first ? span.begin : std::min(begin, span.begin);
    end = std::max(end, span.end);
    first = false;
  }
  contestant.online.push_back((end - begin) * 1e-6);
}

std::size_t peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) / 1024;
  return 0;
}

nlohmann::ordered_json to_json(const Contestant& contestant) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < contestant.stages.size(); ++i)
    if (!contestant.stages[i].empty())
      stages[contestant.configuration.scenes.nodes[i].name] = median(contestant.stages[i]);
  return {{"train_s", median(contestant.training)},
          {"online_s", median(contestant.online)},
          {"stages_s", stages}};
}

void print_stages(const std::string& name, const nlohmann::ordered_json& result) {
  std::printf("\n%s\n%-24s %10s %7s\n", name.c_str(), "stage", "ms", "share");
  double sum = 0;
  for (const auto& [stage, seconds] : result["stages_s"].items()) sum += seconds.get<double>();
  for (const auto& [stage, seconds] : result["stages_s"].items())
    if (seconds.get<double>() >= 5e-5)
      std::printf("%-24s %10.1f %6.1f%%\n", stage.c_str(), 1e3 * seconds.get<double>(),
                  100 * seconds.get<double>() / sum);
}

void print_methods(const nlohmann::ordered_json& methods) {
  const double ours = methods.front()["online_s"].get<double>();
  const double training = methods.front()["train_s"].get<double>();
  std::printf("\n%-24s %10s %8s %10s %8s\n", "method", "scan s", "ratio", "training s", "ratio");
  for (const auto& [name, result] : methods.items())
    std::printf("%-24s %10.3f %8.2f %10.3f %8.2f\n", name.c_str(), result["online_s"].get<double>(),
                result["online_s"].get<double>() / ours, result["train_s"].get<double>(),
                result["train_s"].get<double>() / training);
  std::printf("\nscan: all stages of one scan but loading. Medians. Peak memory %zu MB.\n",
              peak_memory_mb());
}

}  // namespace

int bench_command(const BenchCommand& command) {
  if (!command.compare.empty()) {
    std::fputs(compare_benches(command.compare.at(0), command.compare.at(1)).c_str(), stdout);
    return 0;
  }
  if (command.models.empty() || command.scenes.empty())
    throw std::invalid_argument("expected --models FILE... and --scenes FILE...");
  const ModelFiles models = list_models(command.models);
  const std::vector<SceneEntry> scenes = list_scenes(command.scenes);
  std::vector<Contestant> contestants;
  for (const Method& method : find_methods(command.methods)) {
    Contestant& contestant = contestants.emplace_back();
    contestant.method = method;
    contestant.configuration =
        load_configuration(command.config, without_writers(command, method), {}, method.pipeline);
    contestant.stages.resize(contestant.configuration.scenes.nodes.size());
  }
  for (int turn = 0; turn < command.repeat; ++turn) {
    std::fprintf(stderr, "turn %d of %d\n", turn + 1, command.repeat);
    for (Contestant& contestant : contestants) {
      train_once(contestant, models);
      for (const SceneEntry& scene : scenes) run_once(contestant, scene);
    }
  }
  nlohmann::ordered_json methods = nlohmann::ordered_json::object();
  for (const Contestant& contestant : contestants)
    methods[contestant.method.name] = to_json(contestant);
  for (const auto& [name, result] : methods.items()) print_stages(name, result);
  print_methods(methods);
  if (command.out.empty()) return 0;
  write_text(command.out, methods.dump(2) + "\n");
  return 0;
}

}  // namespace posevote
