// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "tools/experiment/experiment.hpp"
namespace posevote {
int recognition_experiment(const ExperimentCommand&, const std::filesystem::path&,
                           const std::atomic<bool>&) {
  throw std::invalid_argument("not yet");
}
}  // namespace posevote
