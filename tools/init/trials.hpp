// SPDX-License-Identifier: BSD-3-Clause
// Runs the default pipeline on one scan under settings that are in question: what is found says
// which of them are right.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nodes/data/detections.hpp"
#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "tools/init/settings.hpp"

namespace posevote::init {

/// From here on something is found; and it needs no other trial.
inline constexpr double kFound = 0.5, kSure = 0.9;

/// What came of a scan.
struct Trial {
  std::string failed;                 ///< "node: why", or ""
  std::vector<std::string> warnings;  ///< of load_scene
  std::vector<Detection> found;       ///< from kFound up, in descending order of confidence
  double best = 0;                    ///< the highest confidence of all, rejected ones too
};

class Trials {
 public:
  /// `cache`: of trained libraries.
  Trials(ModelFiles models, std::filesystem::path cache)
      : models_(std::move(models)), cache_(std::move(cache)) {}

  /// Runs the defaults with these settings. Throws std::runtime_error where no model can be used.
  Trial run(const SceneFile& scan, const Settings& settings);
  /// Runs a config file as it is, and draws what is found into `picture`.
  Trial run(const SceneFile& scan, const std::filesystem::path& config,
            const std::filesystem::path& picture);
  int count() const { return count_; }

 private:
  Trial run_with(const SceneFile& scan, const std::string& config,
                 const std::vector<std::string>& sets, const std::filesystem::path& out);

  ModelFiles models_;
  std::filesystem::path cache_;
  std::map<std::string, std::shared_ptr<const ModelLibrary>> libraries_;  ///< by library_key
  int count_ = 0;
};

}  // namespace posevote::init
