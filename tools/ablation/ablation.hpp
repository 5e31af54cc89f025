// SPDX-License-Identifier: BSD-3-Clause
// What does each term of the method bring? Every parameter of the segmentation, and of the training
// of near symmetries, is switched off, halved and doubled, on replicas of the paper's sets and on
// real ones. An image goes through the pipeline once, up to the densities; then the segmentation
// alone runs again for each variation, so that some two hundred of them take minutes.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/experiment/experiment.hpp"
#include "tools/experiment/test_set.hpp"

namespace posevote {

/// Prints a table and writes it as BASE.json, BASE.csv and BASE.md. Status 130 where it was interrupted.
int ablation_experiment(const ExperimentCommand& command, const std::filesystem::path& out,
                        const std::atomic<bool>& interrupted);

namespace ablation {

/// What a variation reaches on a set.
struct Outcome {
  int instances = 0;   ///< that are to be found
  double correct = 0;  ///< of these
  int wrong = 0;       ///< detections
  double seconds = 0;  ///< of the segmentation, all images
};

/// A line of the table.
struct Row {
  std::string term, change, value;
  std::vector<Outcome> outcomes;  ///< by set
};

/// All rows on one set, that of no change first. Fewer images where interrupted.
std::vector<Row> ablate(const TestSet& set, const std::vector<std::string>& terms,
                        const std::filesystem::path& cache, const std::atomic<bool>& interrupted);

/// A table of all rows, each compared with the first.
std::string to_markdown(const std::vector<TestSet>& sets, const std::vector<Row>& rows);
nlohmann::ordered_json to_json(const std::vector<TestSet>& sets, const std::vector<Row>& rows);
std::string to_csv(const std::vector<TestSet>& sets, const std::vector<Row>& rows);

}  // namespace ablation
}  // namespace posevote
