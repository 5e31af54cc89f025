// SPDX-License-Identifier: BSD-3-Clause
// What a run has read, found again for the page: its scans, its models and, where a data set has
// them, the true poses.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nodes/layouts/ground_truth.hpp"
#include "pipelines/configuration.hpp"
#include "tools/manifest/run_inputs.hpp"
#include "tools/report/run_results.hpp"

namespace posevote::page {

/// A data set as the user names it; no dataset: that of the run.
struct TruthSource {
  std::string dataset, split = "test";
};

/// Which scan, as the run's results have it.
struct ScanName {
  std::size_t frame = 0;
  std::string file;
  int scene_id = 0, im_id = 0;
};

class ShownRun {
 public:
  /// What cannot be found again is told in notes().
  ShownRun(const std::filesystem::path& folder, const TruthSource& truth);

  /// In the frame and by the parameters of the run. Throws std::runtime_error naming the file and
  /// the cause where it is gone or cannot be read.
  Scan load(const ScanName& scan) const;
  /// The same, unread.
  SceneFile locate(const ScanName& scan) const;
  /// Poses in that frame; none where they are not known.
  std::vector<layouts::TrueInstance> truths(const ScanName& scan) const;
  bool has_truth() const { return truth_.has_value(); }

  /// All that were sought, in ascending order of obj_id.
  const std::vector<SoughtModel>& models() const { return models_; }
  /// Its surface [m], or nothing where it cannot be found. Those of `models()`.
  std::map<int, Mesh> load_surfaces();
  /// What the truth calls it; "" where there is none.
  std::string true_name(int obj_id) const;

  /// To run its nodes again. Throws std::invalid_argument where effective.yaml cannot be used, or a
  /// model or library is gone.
  const Configuration& configuration() const;
  std::shared_ptr<const ModelLibrary> library() const { return inputs_.library(configuration()); }

  const std::vector<RunStart>& starts() const { return inputs_.manifest().starts; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void read_configuration();
  void read_dataset(const TruthSource& source);
  void read_truth(const TruthSource& source);

  RunInputs inputs_;
  std::vector<SoughtModel> models_;
  std::optional<Configuration> configuration_;
  std::string no_configuration_;                       ///< why not
  std::map<std::filesystem::path, SceneFile> scenes_;  ///< of the data set, by canonical path
  std::optional<layouts::GroundTruth> truth_;
  bool is_runs_dataset_ = false;
  std::vector<std::string> notes_;
};

}  // namespace posevote::page
