// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/experiment.hpp"

#include <algorithm>
#include <stdexcept>

namespace posevote {
namespace {

const std::vector<Method> kMethods = {{"posevote", "recognize"},
                                      {"ransac", "ransac"},
                                      {"hough3d", "hough3d"},
                                      {"geometric_consistency", "geometric_consistency"}};

}  // namespace

std::vector<Method> find_methods(const std::vector<std::string>& wanted) {
  if (wanted.empty()) return kMethods;
  std::vector<Method> methods;
  for (const std::string& name : wanted) {
    const auto found = std::find_if(kMethods.begin(), kMethods.end(),
                                    [&](const Method& method) { return method.name == name; });
    if (found == kMethods.end()) {
      std::string text = "--methods " + name + ": no such method, expected one of";
      for (const Method& method : kMethods) text.append(" ").append(method.name);
      throw std::invalid_argument(text);
    }
    methods.push_back(*found);
  }
  return methods;
}

int experiment_command(const ExperimentCommand& command, const std::atomic<bool>& interrupted) {
  const std::filesystem::path out = command.out.empty() ? "out/" + command.name : command.out;
  return command.name == "sensitivity" ? sensitivity_experiment(command, out, interrupted)
                                       : recognition_experiment(command, out, interrupted);
}

}  // namespace posevote
