// SPDX-License-Identifier: BSD-3-Clause
// How far scores can be believed: results of runs at hand, on sets with true poses, each alone and
// all together.
#include "tools/evaluate/calibration.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/evaluate/evaluate.hpp"
#include "tools/experiment/experiment.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// A data set and the results of a run on it.
struct JudgedRun {
  std::string dataset, results;
};

JudgedRun parse_run(const std::string& text) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw std::invalid_argument("--runs " + text + ": expected DATASET=RESULTS");
  return {text.substr(0, at), text.substr(at + 1)};
}

/// Of the last folder, which tells sets apart in tables.
std::string name_of(const fs::path& dataset) {
  return dataset.has_filename() ? dataset.filename().string()
                                : dataset.parent_path().filename().string();
}

std::vector<Verdict> judge(const JudgedRun& run, const std::string& rule) {
  EvaluateOptions options;
  options.rules = rule;
  options.results = run.results;
  const Evaluation evaluation = evaluate(layouts::read_ground_truth(run.dataset, "test"),
                                         read_results_csv(run.results), options);
  if (evaluation.rules.size() != 1 || evaluation.rules[0].average())
    throw std::invalid_argument("--rule " + rule + ": expected one that is met or not");
  return evaluation.all[0].verdicts;
}

Calibration calibrate(const std::vector<Verdict>& verdicts, const std::string& results) {
  const auto calibration = posevote::calibrate(verdicts);
  if (!calibration)
    throw std::invalid_argument(results + ": has scores outside of [0, 1], no probabilities");
  return *calibration;
}

void print(const NamedCalibration& named) {
  double mean = 0, right = 0;
  const Calibration& calibration = named.calibration;
  for (const ReliabilityBin& bin : calibration.bins)
    mean += bin.count * bin.mean_score, right += bin.count * bin.right;
  const double count = std::max(1, calibration.count);
  std::printf("%-24s %10d %11.3f %7.3f %7.3f\n", named.name.c_str(), calibration.count,
              mean / count, right / count, calibration.error);
}

nlohmann::ordered_json to_json(const NamedCalibration& named) {
  nlohmann::ordered_json json{{"set", named.name},
                              {"detections", named.calibration.count},
                              {"ece", named.calibration.error}};
  for (const ReliabilityBin& bin : named.calibration.bins)
    json["bins"].push_back({{"from", bin.from},
                            {"to", bin.to},
                            {"detections", bin.count},
                            {"mean_score", bin.mean_score},
                            {"right", bin.right}});
  return json;
}

}  // namespace

int calibration_experiment(const ExperimentCommand& command, const fs::path& out) {
  if (command.runs.empty())
    throw std::invalid_argument("calibration needs --runs DATASET=RESULTS ...");
  const std::string rule = command.rule.empty() ? "add" : command.rule;
  std::vector<NamedCalibration> all;
  std::vector<Verdict> together;
  for (const std::string& text : command.runs) {
    const JudgedRun run = parse_run(text);
    const std::vector<Verdict> verdicts = judge(run, rule);
    all.push_back({name_of(run.dataset), calibrate(verdicts, run.results)});
    together.insert(together.end(), verdicts.begin(), verdicts.end());
  }
  all.push_back({"all", *posevote::calibrate(together)});
  std::printf("%-24s %10s %11s %7s %7s\n", choose_rules(rule)[0].text.c_str(), "detections",
              "mean score", "right", "ECE");
  for (const NamedCalibration& named : all) print(named);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const NamedCalibration& named : all) json.push_back(to_json(named));
  fs::create_directories(out);
  write_report(out / "calibration", json.dump(1) + "\n", reliability_csv(all),
               reliability_svg(all));
  return 0;
}

}  // namespace posevote
