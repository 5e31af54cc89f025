// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bench/contestant.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>

namespace posevote {
namespace {

constexpr const char* kLoading = "load_scene";

/// Writers would measure the disk.
std::vector<std::string> without_writers(const BenchCommand& command, const Method& method) {
  std::vector<std::string> sets = method.set;
  sets.insert(sets.end(), command.set.begin(), command.set.end());
  const graph::Plan plan = load_configuration(command.config, sets, {}, method.pipeline).scenes;
  for (const graph::PlannedNode& node : plan.nodes)
    for (const graph::ParamSpec& param : node.spec->params)
      if (node.outputs.empty() && param.name == "every") sets.push_back(node.name + ".every=0");
  return sets;
}

}  // namespace

Contestant make_contestant(const BenchCommand& command, const Method& method) {
  Contestant contestant;
  contestant.method = method;
  contestant.configuration =
      load_configuration(command.config, without_writers(command, method), {}, method.pipeline);
  contestant.stages.resize(contestant.configuration.scenes.nodes.size());
  return contestant;
}

void train_once(Contestant& contestant, const ModelFiles& models) {
  const auto begin = std::chrono::steady_clock::now();
  contestant.constants =
      constants_of(contestant.configuration, train(contestant.configuration, models));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  contestant.training.push_back(seconds.count());
}

void run_once(Contestant& contestant, const SceneEntry& scene) {
  const ScenePipeline& plan = contestant.configuration.scenes;
  const auto result =
      graph::run_one(plan, contestant.constants,
                     {{scene.number, scene.name, {}, 0, scene.file.path, {}}, {scene.file}});
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

}  // namespace posevote
