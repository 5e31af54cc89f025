// SPDX-License-Identifier: BSD-3-Clause
// Compares a run's results with the true poses of a data set.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nodes/layouts/ground_truth.hpp"
#include "tools/evaluate/curve.hpp"
#include "tools/evaluate/results_csv.hpp"
#include "tools/evaluate/rules.hpp"

namespace posevote {

struct EvaluateOptions {
  std::string rules = "pose,drost,add,adi15";
  /// Instances less visible are left out, found or not. A list of targets says itself which count.
  double least_visible = 0.1;
  double min_score = -std::numeric_limits<double>::infinity();  ///< of recall, precision and F1
  std::string results = "results";                              ///< their name in messages
  int top = 0;  ///< judge only so many detections of an object in an image; 0: all
};

/// One true instance and the detection that was matched with it, or else lies nearest to it.
struct InstanceResult {
  int scene_id = 0, im_id = 0, obj_id = 0;
  std::optional<double> visible;  ///< fraction
  bool counted = true;            ///< false: less visible than asked for, or no target
  bool found = false;             ///< whether score and errors hold
  double score = 0;
  PairErrors errors;
  /// By rule: whether a detection from min_score up was matched with it; of average recalls the
  /// share of conditions; kUnknown where it cannot be measured.
  std::vector<double> met;
};

struct VisibleBin {
  int instances = 0;
  double correct = 0;
};

/// One rule over one object or all.
struct RuleResult {
  Counts counts;                  ///< from min_score up
  int unmeasured = 0;             ///< counted instances without the depth image or camera it needs
  std::vector<Verdict> verdicts;  ///< on its detections; empty for average recalls
  std::vector<CurvePoint> curve;  ///< of these
  std::array<VisibleBin, 10> by_visibility;  ///< 0-10 % .. 90-100 % visible
};

struct Evaluation {
  EvaluateOptions options;
  std::vector<Rule> rules;
  std::vector<InstanceResult> instances;           ///< as in the truth
  std::map<int, std::vector<RuleResult>> objects;  ///< by obj_id, then by rule
  std::map<int, std::string> names;                ///< of objects
  std::vector<RuleResult> all;                     ///< by rule
  std::vector<std::string> notes;                  ///< what was not judged
};

/// Expected calibration error of all detections that a rule judged; kUnknown where a score is no
/// probability or there are no detections.
double calibration_error(const RuleResult& result);

/// How far the covariances of right detections can be believed.
struct Coverage {
  int known = 0;   ///< right detections that have a covariance
  int within = 0;  ///< of these, those whose true error lies within its 95 % ellipsoid
  double share() const { return known > 0 ? static_cast<double>(within) / known : kUnknown; }
};
Coverage coverage_of(const RuleResult& result);

/// Of the instances that a detection finds by the closest points (rule `adds`), those that it finds
/// by the points themselves (`add`), too: the right way round, where a shape looks alike.
struct WayRound {
  int found = 0, right = 0;
  double share() const { return found > 0 ? static_cast<double>(right) / found : kUnknown; }
};
/// By obj_id, 0 being all; empty where the rules are not both asked for.
std::map<int, WayRound> right_way_round(const Evaluation& evaluation);

/// Of the truth's instances, which count: those visible enough, or where there is a list of targets
/// the most visible ones that it asks for.
std::vector<bool> which_count(const layouts::GroundTruth& truth, double least_visible);

/// For each image, object and condition, detections take in descending order of their score the
/// nearest right instance that is still free; the others are false positives, but one that finds an
/// instance that is not counted is neither. Of BOP's average recalls, as many detections are judged
/// as instances count, the best first. Throws std::runtime_error naming a row (line) whose image or
/// object is not in the data set.
Evaluation evaluate(const layouts::GroundTruth& truth, const std::vector<FoundInstance>& found,
                    const EvaluateOptions& options = {});

/// Text: with `instances`, a line for each; and a summary that names the rule beside every number.
std::string to_text(const Evaluation& evaluation, bool instances);

}  // namespace posevote
