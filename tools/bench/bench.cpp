// SPDX-License-Identifier: BSD-3-Clause
// Methods take turns, so that a machine that slows down slows all of them; figures are medians.
#include "tools/bench/bench.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/bench/contestant.hpp"
#include "tools/json_answer.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

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
  const JsonAnswer answer(command.json);
  if (!command.compare.empty()) {
    const auto comparison = compare_benches(command.compare.at(0), command.compare.at(1));
    if (!command.json) std::fputs(to_table(comparison).c_str(), stdout);
    answer.give(comparison);
    return 0;
  }
  if (!command.growth.empty()) {
    answer.give(bench_growth(command));
    return 0;
  }
  if (command.models.empty() || command.scenes.empty())
    throw std::invalid_argument("expected --models FILE... and --scenes FILE...");
  const std::vector<Method> chosen = find_methods(command.methods);
  const ModelFiles models = list_models(command.models);
  const std::vector<SceneEntry> scenes = list_scenes(command.scenes);
  std::vector<Contestant> contestants;
  for (const Method& method : chosen) contestants.push_back(make_contestant(command, method));
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
  answer.give(methods);
  if (!command.json) {
    for (const auto& [name, result] : methods.items()) print_stages(name, result);
    print_methods(methods);
  }
  if (command.out.empty()) return 0;
  write_text(command.out, methods.dump(2) + "\n");
  return 0;
}

}  // namespace posevote
