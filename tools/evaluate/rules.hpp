// SPDX-License-Identifier: BSD-3-Clause
// When is a pose right? Each rule is a row of one table: the errors that it needs, and conditions
// on them. A rule with several conditions (BOP's average recalls) counts by the share of them met.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/evaluate/pose_error.hpp"

namespace posevote {

/// How far a found pose is from a true one; kUnknown where no rule asked, or data lack.
struct PairErrors {
  double center = kUnknown;       ///< [m]
  double rotation = kUnknown;     ///< [rad]
  double add = kUnknown;          ///< [m]
  double adds = kUnknown;         ///< [m]
  double mssd = kUnknown;         ///< [m]
  double mspd = kUnknown;         ///< [pixel of an image 640 wide]
  double vsd_2018 = kUnknown;     ///< tau 20 mm
  double surprise = kUnknown;     ///< PoseMeter::surprise, where the results have a covariance
  std::vector<double> vsd_steps;  ///< tau 0.05 .. 0.5 diameter; empty: unknown
};

enum class Needs { poses, camera, depth };

/// One condition: right or wrong, and which of two right ones is the better (smaller).
struct Condition {
  std::function<bool(const PairErrors&, double diameter)> accepts;
  std::function<double(const PairErrors&)> order;
};

struct Rule {
  std::string name;                   ///< on the command line
  std::string text;                   ///< in tables
  Needs needs = Needs::poses;         ///< what an image must have
  std::vector<Condition> conditions;  ///< more than one: an average recall
  bool takes_look_alikes = false;     ///< a pose that looks nearly the same is as right
  bool average() const { return conditions.size() > 1; }
};

/// All rules, in the order of reports.
const std::vector<Rule>& all_rules();

/// Those of a list like "pose,mssd", or of "all". Throws std::invalid_argument.
std::vector<Rule> choose_rules(const std::string& list);

}  // namespace posevote
