// SPDX-License-Identifier: BSD-3-Clause
// Compares a run's results with the true poses of a BOP data set.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace posevote {

struct EvaluateOptions {
  std::string split = "test";
  double most_mm = 50;         ///< pose rule: distance of the model centres, and
  double most_deg = 7.5;       ///< rotation error, as in the UWA authors' scripts
  double add_fraction = 0.1;   ///< ADD rule: ADD (symmetric objects: ADI) over the diameter
  double least_visible = 0.1;  ///< instances less visible are left out, found or not, as BOP does
};

/// One true instance and the detection that was matched with it, or else lies nearest to it.
struct InstanceResult {
  int scene_id = 0, im_id = 0, obj_id = 0;
  std::optional<double> visible;  ///< fraction
  bool counted = true;            ///< false: less visible than asked for
  bool found = false;             ///< whether the numbers below hold
  double score = 0, mm = 0, deg = 0, add_mm = 0;
  bool pose_ok = false;  ///< some detection is matched with it by the pose rule
  bool add_ok = false;   ///< ... by the ADD rule
};

/// How often one rule was met.
struct Counts {
  int instances = 0, detections = 0, correct = 0;
  double recall() const { return ratio(correct, instances); }
  double precision() const { return ratio(correct, detections); }
  double f1() const { return ratio(2 * correct, instances + detections); }

 private:
  static double ratio(int part, int whole) { return whole > 0 ? 1.0 * part / whole : 0; }
};

struct RuleCounts {
  Counts pose, add;
};

struct Evaluation {
  EvaluateOptions options;
  std::vector<InstanceResult> instances;
  std::map<int, RuleCounts> objects;  ///< by obj_id
  RuleCounts all;
};

/// For each image, object and rule, detections take in descending order of their score the nearest
/// correct instance that is still free; the others are false positives. Throws std::runtime_error
/// naming what is wrong with the truth (file) or the results (file:line).
Evaluation evaluate(const std::filesystem::path& dataset, const std::string& results_csv,
                    const EvaluateOptions& options = {});

/// A table with a line for each instance, and a summary that names the rule beside every number.
std::string to_text(const Evaluation& evaluation);

}  // namespace posevote
