// SPDX-License-Identifier: BSD-3-Clause
// Commands about data with true poses: simulate makes it, evaluate measures against it.
#include <iostream>

#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/simulate/simulate.hpp"

namespace posevote {

int simulate_command(const SimulateCommand& command) {
  simulate(command.spec, command.out);
  std::cout << "wrote " << command.out << "\n";
  return 0;
}

int evaluate_command(const EvaluateCommand& command) {
  EvaluateOptions options;
  options.split = command.split;
  std::cout << to_text(evaluate(command.dataset, command.results, options));
  return 0;
}

}  // namespace posevote
