// SPDX-License-Identifier: BSD-3-Clause
// What a sweep has found in each scan, kept in --out (scans.json): one that is killed goes on.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nodes/formats/append_json.hpp"
#include "pipelines/inputs.hpp"
#include "tools/sweep/shared_stages.hpp"

namespace posevote::sweep {

/// What one setting says of one scan.
struct Answer {
  struct Pose {
    int obj_id = 0;
    double score = 0;
    Eigen::Isometry3d T_scene_model;  ///< [m]
  };
  double seconds = 0;
  std::optional<std::string> failure;  ///< "node: what"
  std::vector<Pose> found;
};

/// What all settings say of one scan, in their order.
struct ScanAnswers {
  std::vector<Answer> settings;
  SharedStages::AllCalls calls;
};

class Journal {
 public:
  /// Begins one in `out`, or goes on with the one that is there, if there is, of a sweep of the same
  /// settings over those scans; scans that failed are searched again. Throws std::invalid_argument
  /// where a scan is another now, and std::runtime_error where the file cannot be read or written, or
  /// is not what a sweep wrote.
  Journal(const std::filesystem::path& out, bool resume, const std::vector<SceneEntry>& scans);

  /// Null for a scan that is still to be searched.
  const ScanAnswers* find(std::size_t scan) const;
  std::size_t count() const { return known_.size(); }
  /// Is on the disk when it returns. Throws std::runtime_error where it cannot be written.
  const ScanAnswers& add(const SceneEntry& scan, ScanAnswers answers);

 private:
  std::map<std::size_t, ScanAnswers> known_;
  std::filesystem::path file_;
  std::optional<formats::AppendJson> list_;
};

}  // namespace posevote::sweep
