// SPDX-License-Identifier: BSD-3-Clause
// One image: every detection of an object against every true instance of it.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include "tools/evaluate/evaluate.hpp"

namespace posevote {

inline constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// An object in an image.
struct Case {
  std::vector<const layouts::TrueInstance*> instances;
  std::vector<InstanceResult*> results;     ///< of these instances, to be filled in
  std::vector<const FoundInstance*> found;  ///< best score first
};

/// A judged case: by rule, its part of that rule's counts.
struct CaseResult {
  int obj_id = 0;
  std::vector<std::vector<Verdict>> verdicts;  ///< empty for average recalls
  std::vector<int> unmeasured;                 ///< counted instances, by rule
};

/// Fills in the cases' results. `cases` by obj_id.
std::vector<CaseResult> judge_image(const layouts::GroundTruth& truth, const layouts::ImageKey& key,
                                    std::map<int, Case>& cases,
                                    const std::map<int, PoseMeter>& meters,
                                    const std::vector<Rule>& rules, double min_score);

}  // namespace posevote
