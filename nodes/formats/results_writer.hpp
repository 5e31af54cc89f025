// SPDX-License-Identifier: BSD-3-Clause
// Writes what a run finds, frame by frame: results.csv (BOP), results.json, failures.json.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "graph/frame_context.hpp"
#include "graph/trace.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "nodes/formats/append_json.hpp"

namespace posevote::formats {

/// A frame as it is reported.
struct FrameReport {
  std::size_t number = 0;
  SceneFile file;
  double seconds = 0;  ///< of the machine: of the run's time its share (graph::cost)
  std::map<std::string, double> stages;  ///< of them, per node
  std::string name;                      ///< of the files that writers make for it
  graph::Figures figures{};              ///< of all nodes
  std::vector<graph::Warning> warnings{};
};

struct FailureReport {
  std::size_t number = 0;
  std::filesystem::path file;
  std::string node;
  std::string what;
};

/// Makes the files of a run in `out`; with `resume`, they hold what an earlier one answered, whose
/// frames are returned. Failed ones are not among them: a resumed run tries them again. `scans`:
/// the file of each frame. `left_out`: models that are not sought. Throws std::invalid_argument, and leaves all as it is, where `out` holds
/// another run and `resume` is false, or where it holds frames of other files; and
/// std::runtime_error where it cannot be written.
std::set<std::size_t> begin_results(const std::filesystem::path& out, bool resume,
                                    const std::map<std::size_t, std::filesystem::path>& scans = {},
                                    const std::vector<LeftOutModel>& left_out = {});

/// Appends to the files that begin_results has made. Throws std::runtime_error where one cannot be
/// written.
class ResultsWriter {
 public:
  explicit ResultsWriter(const std::filesystem::path& out);

  /// `nodes`: the run's totals per node so far.
  void write(const FrameReport& frame, const Detections& detections,
             const std::vector<graph::NodeTimes>& nodes);
  void write(const FailureReport& failure);

 private:
  std::filesystem::path csv_file_;
  std::ofstream csv_;
  AppendJson results_;
  AppendJson failures_;
};

/// Items of a results.json or failures.json.
struct WrittenFrames {
  std::vector<nlohmann::ordered_json> items;
  std::size_t torn = 0;  ///< lines left out
};

/// The models that a run did not seek, as its results.json says before the frames.
std::vector<LeftOutModel> read_left_out(const std::filesystem::path& file);

/// Each line is read alone: a killed run may have torn the last one. Lines without `key` are left
/// out, too. Nothing where there is no such file.
WrittenFrames read_frames(const std::filesystem::path& file, const std::string& key);

/// "scene_id,im_id,obj_id,score,R,t,time": R row by row, t in mm, time in s; one line a detection.
std::string csv_rows(const FrameReport& frame, const Detections& detections);

}  // namespace posevote::formats
