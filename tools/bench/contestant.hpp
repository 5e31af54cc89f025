// SPDX-License-Identifier: BSD-3-Clause
// One method, ready to run, and what was measured of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/runner.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/bench/bench.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/quantiles.hpp"

namespace posevote {

using Samples = std::vector<double>;

struct Contestant {
  Method method;
  Configuration configuration;
  graph::Constants constants;
  Samples training, online;  ///< [s]; online: a scan, loading aside
  std::vector<Samples> stages;
};

/// The command's config with the method's wiring, without what writes files.
Contestant make_contestant(const BenchCommand& command, const Method& method);
void train_once(Contestant& contestant, const ModelFiles& models);
/// Throws std::runtime_error naming the scan, the node and the cause where it fails.
void run_once(Contestant& contestant, const SceneEntry& scene);

/// The most memory that this process has taken so far [MB].
std::size_t peak_memory_mb();

}  // namespace posevote
