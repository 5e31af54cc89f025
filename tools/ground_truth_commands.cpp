// SPDX-License-Identifier: BSD-3-Clause
// Commands about data with true poses: simulate makes it, evaluate measures against it.
#include <iostream>

#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/evaluate/results_json.hpp"
#include "tools/evaluate/write_evaluation.hpp"
#include "tools/simulate/simulate.hpp"

namespace posevote {

int simulate_command(const SimulateCommand& command) {
  simulate(command.spec, command.out);
  std::cout << "wrote " << command.out << "\n";
  return 0;
}

int evaluate_command(const EvaluateCommand& command) {
  constexpr std::size_t kMostLines = 40;
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
  std::cout << to_text(evaluation, command.verbose || evaluation.instances.size() <= kMostLines);
  if (!command.out.empty()) {
    write_evaluation(evaluation, command.out);
    std::cout << "wrote " << command.out << "\n";
  }
  return 0;
}

}  // namespace posevote
