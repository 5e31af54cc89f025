// SPDX-License-Identifier: BSD-3-Clause
// `posevote sweep`: which values of some parameters find most? Every combination is tried on the
// scans of a data set with true poses; a scan goes through all of them at once, so that what they
// have in common is done once.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/sweep/bootstrap.hpp"
#include "tools/sweep/grid.hpp"
#include "tools/sweep/shared_stages.hpp"

namespace posevote {

struct SweepCommand {
  RunCommand run;                 ///< as `run` has it; `out` gets the table and the plot
  std::vector<std::string> vary;  ///< node.param=value,value...
  EvaluateOptions judge;
  std::string targets;    ///< as `evaluate` has it
  std::size_t every = 1;  ///< one scan of so many
};

/// Prints a table for each rule and writes sweep.json, sweep.csv and sweep.svg to `out`, beside
/// run.json and scans.json, by which it can be gone on with. Status 1 where a scan failed or a model
/// was left out, 130 where it was interrupted, with the scans so far.
int sweep_command(const SweepCommand& command, const std::atomic<bool>& interrupted);

namespace sweep {

/// What one combination of values finds.
struct Setting {
  Values values;
  std::vector<FoundInstance> found;
  std::size_t failed = 0;  ///< scans
  double seconds = 0;      ///< all scans, one at a time, as if nothing were shared
};

/// One rule, by setting.
struct Judged {
  Rule rule;
  std::vector<Counts> counts;
  std::vector<Certainty> certainty;
  std::size_t best = 0;  ///< of equals the first
  /// False where nothing could be judged by it, as by VSD without depth images.
  bool applies() const { return counts.at(best).instances > 0; }
};

struct Sweep {
  std::vector<Axis> axes;
  std::vector<Setting> settings;
  std::vector<Judged> rules;
  std::size_t images = 0;
  SharedStages::AllCalls calls;
};

/// What settings are compared by: F1, which an average recall does not have.
inline Figure figure_of(const Rule& rule) { return rule.average() ? &Counts::recall : &Counts::f1; }

/// By every rule that the options name, over those images.
std::vector<Judged> judge(const layouts::GroundTruth& truth, const EvaluateOptions& options,
                          const std::vector<Setting>& settings,
                          const std::set<layouts::ImageKey>& images, std::uint64_t seed);

std::string to_text(const Sweep& sweep);
/// One row for each rule and setting, of plain values.
nlohmann::ordered_json rows_of(const Sweep& sweep);
nlohmann::ordered_json to_json(const Sweep& sweep);
/// Recall, F1 and time over the values of the first axis, by the first rule that applies.
std::string to_svg(const Sweep& sweep);

}  // namespace sweep
}  // namespace posevote
