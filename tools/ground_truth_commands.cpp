// SPDX-License-Identifier: BSD-3-Clause
// Commands about data with true poses: simulate makes it, evaluate measures against it.
#include <cmath>
#include <iostream>
#include <numbers>

#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/evaluate/results_json.hpp"
#include "tools/evaluate/write_evaluation.hpp"
#include "tools/json_answer.hpp"
#include "tools/simulate/simulate.hpp"

namespace posevote {

namespace {

/// The table of instances; null where there is no detection, or no way to measure it.
nlohmann::ordered_json instances_json(const Evaluation& evaluation) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const InstanceResult& result : evaluation.instances) {
    nlohmann::ordered_json& row = rows.emplace_back();
    row = {{"scene_id", result.scene_id}, {"im_id", result.im_id}, {"obj_id", result.obj_id}};
    row["visible"] = result.visible ? nlohmann::ordered_json(*result.visible) : nullptr;
    row["counted"] = result.counted;
    row["score"] = result.found ? nlohmann::ordered_json(result.score) : nullptr;
    const auto put = [&](const char* name, double value) {
      row[name] = result.found && std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
    };
    put("center_mm", result.errors.center * 1000);
    put("rotation_deg", result.errors.rotation * 180 / std::numbers::pi);
    put("add_mm", result.errors.add * 1000);
    for (std::size_t r = 0; r < evaluation.rules.size(); ++r)
      row["met"][evaluation.rules[r].name] = result.met[r];  // NaN is written as null
  }
  return rows;
}

}  // namespace

int simulate_command(const SimulateCommand& command) {
  Spec spec = read_spec(command.spec);
  spec.colors |= command.colors;
  simulate_set(spec, command.out);
  std::cout << "wrote " << command.out << "\n";
  return 0;
}

int evaluate_command(const EvaluateCommand& command) {
  constexpr std::size_t kMostLines = 40;
  const JsonAnswer answer(command.json);
  EvaluateOptions options;
  if (!command.rules.empty()) options.rules = command.rules;
  options.least_visible = command.visible;
  if (command.min_score) options.min_score = *command.min_score;
  options.top = command.top;
  options.results = command.results;
  choose_rules(options.rules);  // a typing mistake shows before the data set is read
  const layouts::GroundTruth truth =
      layouts::read_ground_truth(command.dataset, command.split, command.targets);
  const Evaluation evaluation = evaluate(truth, read_results(command.results), options);
  if (!command.json)
    std::cout << to_text(evaluation, command.verbose || evaluation.instances.size() <= kMostLines);
  if (!command.out.empty()) {
    write_evaluation(evaluation, command.out);
    std::cout << "wrote " << command.out << "\n";
  }
  nlohmann::ordered_json json = to_json(evaluation);
  json["instances"] = instances_json(evaluation);
  answer.give(json);
  return 0;
}

}  // namespace posevote
