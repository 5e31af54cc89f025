// SPDX-License-Identifier: BSD-3-Clause
// Writes what a run finds, frame by frame: results.json, results.csv (BOP), detections.csv,
// failures.json.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "nodes/formats/append_json.hpp"
#include "nodes/formats/results_json.hpp"

namespace posevote::formats {

struct FailureReport {
  std::size_t number = 0;
  std::filesystem::path file;
  std::string node;
  std::string what;
};

/// Which files a run writes: "json" results.json, "csv" detections.csv, "bop" results.csv.
/// failures.json is written always.
inline const std::vector<std::string> kAllResults{"json", "csv", "bop"};

/// Makes the files of a run in `out`; with `resume`, they hold what an earlier one answered, whose
/// frames are returned. Failed ones are not among them: a resumed run tries them again. `scans`:
/// the file of each frame. `left_out`: models that are not sought. Throws std::invalid_argument,
/// and leaves all as it is, where `out` holds another run and `resume` is false, or where it holds
/// frames of other files, or where a run is to be resumed that writes no results.json; and
/// std::runtime_error where it cannot be written.
std::set<std::size_t> begin_results(const std::filesystem::path& out, bool resume,
                                    const std::map<std::size_t, std::filesystem::path>& scans = {},
                                    const std::vector<LeftOutModel>& left_out = {},
                                    const std::vector<std::string>& formats = kAllResults);

/// A table of a run, of which a row is made from a frame's object.
class ResultsTable {
 public:
  using Rows = std::string (*)(const nlohmann::ordered_json& frame);

  /// Goes on with a file that begin_results has made.
  ResultsTable(std::filesystem::path file, Rows rows);
  /// Throws std::runtime_error where the file cannot be written.
  void append(const nlohmann::ordered_json& frame);

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
  Rows rows_;
};

/// Appends to the files that begin_results has made. Throws std::runtime_error where one cannot be
/// written.
class ResultsWriter {
 public:
  explicit ResultsWriter(const std::filesystem::path& out,
                         const std::vector<std::string>& formats = kAllResults);

  /// `nodes`: the run's totals per node so far.
  void write(const FrameReport& frame, const Detections& detections,
             const std::vector<graph::NodeTimes>& nodes);
  void write(const FailureReport& failure);

 private:
  std::vector<ResultsTable> tables_;
  std::optional<AppendJson> results_;
  AppendJson failures_;
};

}  // namespace posevote::formats
