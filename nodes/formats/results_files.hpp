// SPDX-License-Identifier: BSD-3-Clause
// The files of a run as a whole, before its first frame and after its last: begun, gone on with, put
// in the order of the scans. What happens between is results_writer's.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/formats/results_json.hpp"
#include "nodes/formats/results_writer.hpp"

namespace posevote::formats {

/// What a run is about to do.
struct Batch {
  std::map<std::size_t, SceneFile> scans{};  ///< by frame, those of all shards
  std::set<std::size_t> mine{};              ///< frames of this start's shard
  std::vector<LeftOutModel> left_out{};      ///< models that are not sought
  std::vector<std::string> formats = kAllResults;
};

/// What a run that is gone on with has done.
struct Answered {
  std::set<std::size_t> frames;
  std::size_t damaged = 0;  ///< records that are not what was written: their frames are done again
};

/// Makes the files of a run in `out`, without a frame. Throws std::invalid_argument where `out` holds
/// another run, and std::runtime_error where it cannot be written.
void begin_results(const std::filesystem::path& out, const Batch& batch = {});

/// Makes the files anew with what an earlier run has answered, in the order of the scans. Failures of
/// frames that are `mine` are not kept: they are tried again. Throws std::invalid_argument, and
/// leaves all as it is, where an answered frame's scan is another now (its name, numbers, content or
/// camera) or is not there, or without "json" among the formats; and std::runtime_error where the
/// files cannot be read or written.
Answered resume_results(const std::filesystem::path& out, const Batch& batch);

/// When the last frame is written: puts what a resumed run has added in the order of the scans, and
/// all on the disk. Throws std::runtime_error where it cannot be written.
void finish_results(const std::filesystem::path& out, const std::vector<std::string>& formats);

/// All that the files of a run hold.
struct RunContent {
  std::vector<nlohmann::ordered_json> frames, failures;
  std::vector<LeftOutModel> left_out{};
  std::vector<graph::NodeTimes> nodes{};  ///< totals of the run
};

/// Writes it, in the order of the frames, in place of what is there. Throws std::runtime_error.
void write_content(const std::filesystem::path& out, RunContent content,
                   const std::vector<std::string>& formats);

/// What is another of a scan than its frame's record says, its content aside: "" where nothing is.
/// Throws nlohmann::json::exception for what is no record of a frame.
std::string difference(const nlohmann::ordered_json& frame, const SceneFile& scan);

/// Of the records of frames in `file`: the same scans may be reached by another path, or have been
/// moved. Leaves out frames of which nobody knows what their scan held. Throws std::invalid_argument
/// where a frame's scan is another now (its name, numbers, content or camera) or is not there.
void check_same_scans(const std::filesystem::path& file,
                      std::vector<nlohmann::ordered_json>& frames,
                      const std::map<std::size_t, SceneFile>& scans);

/// The frames of a results.json or failures.json, in the order of its lines, by their beginnings: a
/// long run's records are not read for it.
std::vector<std::size_t> frame_numbers(const std::filesystem::path& file);

/// The totals at the end of a results.json. Throws std::runtime_error or nlohmann::json::exception
/// where they are not what a run wrote.
std::vector<graph::NodeTimes> read_node_times(const std::filesystem::path& file);

}  // namespace posevote::formats
