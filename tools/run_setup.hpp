// SPDX-License-Identifier: BSD-3-Clause
// What the options of `run` come to, before the first scan: a configuration, models, a library.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "pipelines/configuration.hpp"
#include "tools/commands.hpp"

namespace posevote {

/// `over`: what is set over all that the command says. Throws graph::ConfigError with every problem.
Configuration read_configuration(const RunCommand& command,
                                 const std::vector<graph::Override>& over = {});

/// None where they come in a library. Throws std::invalid_argument where the command names none.
ModelFiles find_models(const RunCommand& command);

/// From its file, the cache, or trained. Throws graph::Cancelled where it is interrupted.
std::shared_ptr<const ModelLibrary> find_library(const RunCommand& command,
                                                 const Configuration& configuration,
                                                 const ModelFiles& models,
                                                 const std::atomic<bool>& interrupted);

}  // namespace posevote
