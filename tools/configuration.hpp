// SPDX-License-Identifier: BSD-3-Clause
// A config file, the command line's overrides, and the plans that they make.
#pragma once

#include <string>
#include <vector>

#include "graph/plan.hpp"

namespace posevote {

struct Configuration {
  std::string name;      ///< of the config file, without folder and ending
  std::string pipeline;  ///< its name in pipelines/, or the path of another without its ending
  graph::Plan scenes;    ///< runs once a scan
  graph::Plan models;    ///< runs once, makes the library; no nodes where the pipeline needs none
};

/// Reads a config (a path, or the name of one in configs/) or a pipeline, applies `sets`
/// ("node.param=value") over it and checks everything. `defaults` are overrides that yield to both.
/// `pipeline`, unless empty, takes the place of the one that the config names. Throws
/// graph::ConfigError with every problem at once.
Configuration load_configuration(const std::string& config, const std::vector<std::string>& sets,
                                 const std::vector<graph::Override>& defaults = {},
                                 const std::string& pipeline = "");

/// The run's parameters as a config that reproduces it.
std::string effective_yaml(const Configuration& configuration);

/// What the library depends on beside the models: wiring and parameters of the models' plan.
std::string training_parameters(const graph::Plan& models);

}  // namespace posevote
