// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/evaluate/evaluate.hpp"

namespace posevote {

nlohmann::ordered_json to_json(const Evaluation& evaluation);

/// Writes evaluation.json, evaluation.csv, instances.csv, verdicts.csv, precision_recall.csv,
/// precision_recall.svg, reliability.csv, reliability.svg and recall_visibility.svg. Throws
/// std::runtime_error naming a file that cannot be written.
void write_evaluation(const Evaluation& evaluation, const std::filesystem::path& folder);

}  // namespace posevote
