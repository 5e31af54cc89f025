// SPDX-License-Identifier: BSD-3-Clause
// Writes what a run finds, frame by frame: results.json, results.csv (BOP), detections.csv,
// failures.json.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
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

/// A table of a run, of which a row is made from a frame's object.
class ResultsTable {
 public:
  using Rows = std::string (*)(const nlohmann::ordered_json& frame);

  /// Goes on with a file that begin_results has made.
  ResultsTable(std::filesystem::path file, Rows rows);
  /// Throws std::runtime_error where the file cannot be written; it then holds what it held before.
  void append(const nlohmann::ordered_json& frame);
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::uint64_t end_;
  Rows rows_;
};

/// Appends to the files that begin_results (results_files.hpp) has made. After each frame they are
/// whole, whoever kills the run; on the disk, as a loss of power leaves them, is what was written a
/// second or more before the last frame. Throws std::runtime_error where one cannot be written.
class ResultsWriter {
 public:
  explicit ResultsWriter(const std::filesystem::path& out,
                         const std::vector<std::string>& formats = kAllResults);

  /// `nodes`: the run's totals per node so far.
  void write(const FrameReport& frame, const Detections& detections,
             const std::vector<graph::NodeTimes>& nodes);
  void write(const FailureReport& failure);

 private:
  void sync();

  std::filesystem::path out_;
  std::chrono::steady_clock::time_point synced_;
  std::vector<ResultsTable> tables_;
  std::optional<AppendJson> results_;
  AppendJson failures_;
};

}  // namespace posevote::formats
