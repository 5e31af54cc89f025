// SPDX-License-Identifier: BSD-3-Clause
// The paper's five experiments and ours, each as one command.
#pragma once

#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace posevote {

/// Options of `experiment`, named as on the command line.
struct ExperimentCommand {
  std::string name;
  std::string dataset;               ///< the real set; empty: a replica is made
  std::string out;                   ///< empty: out/NAME
  std::vector<std::string> methods;  ///< empty: all
  std::size_t every = 0;             ///< one image of so many; 0: all, or what `quick` says
  bool quick = false, json = false;
  std::vector<double> scales;      ///< of ranges: fixed resolutions to compare with [m]
  std::vector<std::string> runs;   ///< of calibration: DATASET=RESULTS
  std::string rule;                ///< of calibration; empty: add
  std::vector<std::string> sets;   ///< of ablation: replicas by config, CONFIG=DIR for real sets
  std::vector<std::string> terms;  ///< of ablation: only these parameters; empty: all
};

/// A way from scans to poses: the wiring that stands for it.
struct Method {
  std::string name;              ///< in tables and folders
  std::string pipeline;          ///< in pipelines/
  std::vector<std::string> set;  ///< node.param=value
};

/// Ours first, then the rivals that this build has, on the same correspondences; by name in
/// `wanted` also those that differ before or after: PCL's chains on SHOT descriptors, and ours with
/// the paper's way to the densities. Throws std::invalid_argument for a name that there is not.
std::vector<Method> find_methods(const std::vector<std::string>& wanted);

/// Those that the command names, else all; of ranges ours alone, and ours at fixed scales.
std::vector<Method> methods_of(const ExperimentCommand& command);

/// Rows of plain values, all with the same keys, as text for spreadsheets.
std::string to_csv(const nlohmann::ordered_json& rows);
/// Writes BASE.json, BASE.csv and BASE.svg and says so. Throws std::runtime_error for a full disk.
void write_report(const std::filesystem::path& base, const std::string& json,
                  const std::string& csv, const std::string& svg);

int experiment_command(const ExperimentCommand& command, const std::atomic<bool>& interrupted);

/// A model onto noisy copies of itself (paper, section 5.1).
int sensitivity_experiment(const ExperimentCommand& command, const std::filesystem::path& out,
                           const std::atomic<bool>& interrupted);
/// A data set with true poses: the paper's (sections 5.2 to 5.5), or a replica of ours.
int recognition_experiment(const ExperimentCommand& command, const std::filesystem::path& out,
                           const std::atomic<bool>& interrupted);
/// How far scores of results at hand can be believed as probabilities.
int calibration_experiment(const ExperimentCommand& command, const std::filesystem::path& out);

}  // namespace posevote
