// SPDX-License-Identifier: BSD-3-Clause
// Detections of a run, from its results.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/evaluate/results_csv.hpp"

namespace posevote {

/// A detection of a frame; its score is its confidence. Throws nlohmann's exceptions for what is
/// none.
FoundInstance found_instance(const nlohmann::ordered_json& frame,
                             const nlohmann::ordered_json& detection);

/// All of a results.json, as `line` the frame and detection counted from 1. Throws
/// std::runtime_error naming the file and what is wrong.
std::vector<FoundInstance> read_results_json(const std::string& file);

/// Of a results.json, or of a results.csv, whose rows get what a CSV lacks from the results.json of
/// the same run beside it, if there is one.
std::vector<FoundInstance> read_results(const std::string& file);

}  // namespace posevote
