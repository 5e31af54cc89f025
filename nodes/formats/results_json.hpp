// SPDX-License-Identifier: BSD-3-Clause
// results.json as text and read again: a head that says what the numbers mean, a line for each
// frame, and a tail with the times of the nodes. pipelines/results.schema.json says the same to
// programs.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "graph/frame_context.hpp"
#include "graph/trace.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"

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
  std::string scan_hash{};  ///< formats::hash_scan of the file; empty: not known
};

/// The frame's object in results.json, from which the rows of the tables are made, too.
nlohmann::ordered_json to_json(const FrameReport& frame, const Detections& detections);

/// As in camera.json: fx, fy, cx, cy [pixel], depth_scale [mm]; null where there is none.
nlohmann::ordered_json camera_json(const std::optional<Camera>& camera);
/// Reads it again. Throws nlohmann::json::exception.
std::optional<Camera> camera_of(const nlohmann::ordered_json& json);

/// One line; names that are not UTF-8 (paths may be anything) are mended, not thrown at.
std::string line(const nlohmann::ordered_json& json);

/// The line of a frame's object, with the checksum of what stands before it as its last member.
std::string record(const nlohmann::ordered_json& json);

/// Lines for what the numbers mean and for the models that are left out, if there are any, and the
/// beginning of the list.
std::string results_head(const std::vector<LeftOutModel>& left_out);

/// The end of the list, and the run's totals per node so far.
std::string results_tail(const std::vector<graph::NodeTimes>& nodes);

/// The end of failures.json.
inline constexpr const char* kFailuresTail = "\n]\n";

/// Items of a results.json or failures.json, without their checksums.
struct WrittenFrames {
  std::vector<nlohmann::ordered_json> items;
  std::size_t torn = 0;  ///< lines left out
};

/// What to do about a line without a checksum, which another program wrote, or a flipped bit made.
enum class NoChecksum { kTake, kLeaveOut };

/// The models that a run did not seek, as its results.json says before the frames.
std::vector<LeftOutModel> read_left_out(const std::filesystem::path& file);

/// Each line is read alone: a killed run may have torn the last one. Lines without `key`, and lines
/// that are not what their checksum says, are left out, too. Nothing where there is no such file.
WrittenFrames read_frames(const std::filesystem::path& file, const std::string& key,
                          NoChecksum unsure = NoChecksum::kTake);

}  // namespace posevote::formats
