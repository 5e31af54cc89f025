// SPDX-License-Identifier: BSD-3-Clause
// A config file, the command line's overrides, and the plans that they make.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graph/runner.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"

namespace posevote {

/// Finds objects; runs once a scan.
using ScenePipeline = graph::Pipeline<Detections(SceneFile)>;
/// Makes the library that scans are matched against; runs once.
using ModelPipeline = graph::Pipeline<ModelLibrary(ModelFiles)>;

struct Configuration {
  std::string name;      ///< of the config file, without folder and ending
  std::string pipeline;  ///< its name in pipelines/, or the path of another without its ending
  graph::PipelineDescription wiring;  ///< the pipeline as written, with what it extends
  ScenePipeline scenes;  ///< no nodes where the pipeline has no `models`: it makes them itself
  ModelPipeline models;
};

/// Reads a config (a path, or the name of one in configs/) or a pipeline, applies `sets`
/// ("node.param=value") over it and checks everything. `defaults` are overrides that yield to both,
/// `options` those that both yield to. `pipeline`, unless empty, takes the place of the one that the
/// config names. Throws
/// graph::ConfigError with every problem at once.
Configuration load_configuration(const std::string& config, const std::vector<std::string>& sets,
                                 const std::vector<graph::Override>& defaults = {},
                                 const std::string& pipeline = "",
                                 const std::vector<graph::Override>& options = {});

/// What the plan for scans takes from that for models: the library, by its stream's name, and what
/// can be worked out of it once for all scans. Throws std::runtime_error "node: what", and
/// graph::Cancelled by `activity`.
graph::Constants constants_of(const Configuration& configuration,
                              const std::shared_ptr<const ModelLibrary>& library,
                              graph::Activity* activity = nullptr);

/// The run's parameters as a config that reproduces it.
std::string effective_yaml(const Configuration& configuration);

/// What the library depends on beside the models: wiring and parameters of the models' plan.
std::string training_parameters(const graph::Plan& models);

}  // namespace posevote
