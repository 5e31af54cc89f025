// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of `posevote`. Each returns its exit status: 0 done, 1 some frames failed, 2
// nothing ran, 130 after Ctrl-C. Problems of the user's making are thrown: graph::ConfigError and
// std::invalid_argument mean 2.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "graph/registry.hpp"

namespace posevote {

/// Options of `run`, named as on the command line.
struct RunCommand {
  std::string config = "default", pipeline;
  std::vector<std::string> models, scenes, set;
  std::string dataset, split = "test";
  std::string model_unit, scene_unit, sensor_pose;  ///< empty: as the config says
  std::string out = "out";
  std::string library, cache, shard;
  std::string on_error = "skip";
  std::size_t threads = 0, tokens = 0;
  std::uint64_t seed = 0;
  bool resume = false, overwrite = false, quiet = false, verbose = false, json = false;
  bool lines = true;  ///< for each frame of a small run
};
int run_command(const RunCommand& command, const std::atomic<bool>& interrupted);

/// Options of `train`.
struct TrainCommand {
  std::string config = "default";
  std::vector<std::string> models, set;
  std::string out, on_error = "skip";
  std::string model_unit;  ///< empty: as the config says
  bool report = false, quiet = false, json = false;
};
int train_command(const TrainCommand& command);

/// Options of `simulate` and `evaluate`.
struct SimulateCommand {
  std::string spec, out;
  bool colors = false;  ///< whatever the spec says
};
int simulate_command(const SimulateCommand& command);
struct EvaluateCommand {
  std::string dataset, results, split = "test";
  std::string targets, rules, out;
  double visible = 0.1;
  std::optional<double> min_score;
  int top = 0;
  bool verbose = false, json = false;
};
int evaluate_command(const EvaluateCommand& command);

/// Options of `check` and `graph`.
struct InspectCommand {
  std::string config, pipeline;
  std::vector<std::string> set;
  bool flat = false;  ///< prints the pipeline with what it extends as one file
  bool json = false;
};
int check_command(const InspectCommand& command);
int graph_command(const InspectCommand& command);
int configs_command(bool json);
int nodes_command(const std::string& name, bool json);

/// A line that can be pasted into a pipeline, with every parameter but experts' at its default.
std::string example(const graph::NodeSpec& spec);

/// The text of nodes/README.md: every node type with ports, parameters and an example.
std::string node_reference();

}  // namespace posevote
