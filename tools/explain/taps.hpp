// SPDX-License-Identifier: BSD-3-Clause
// One scan of a run once more, with what flows between the stages kept: features, correspondences,
// votes, densities, detections.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "nodes/poses/segment_params.hpp"
#include "pipelines/configuration.hpp"
#include "tools/ablation/replay.hpp"
#include "tools/explain/run_frames.hpp"
#include "tools/manifest/run_inputs.hpp"

namespace posevote::explain {

/// A run's config and models, for all its scans.
struct Run {
  std::filesystem::path out;
  RunInputs inputs;
  std::vector<FrameOfRun> frames;
  Configuration configuration;
  std::shared_ptr<const ModelLibrary> library;
  graph::Constants constants;

  const poses::SegmentParams& segmentation() const;  ///< its parameters
};

/// `models`: take the place of those that the run recorded, unless empty. Throws
/// std::invalid_argument that names what is missing: a folder without a run, models that are gone or
/// changed, a pipeline that does not vote.
Run open_run(const std::filesystem::path& out, const std::vector<std::string>& models = {});

/// The scan as it was read then, with its camera. Throws std::invalid_argument where it is gone.
SceneFile scene_file(const Run& run, const FrameOfRun& frame);

/// The stages of one scan. Keeps a reference to the run.
class Taps {
 public:
  /// Runs the scan. Throws what a node throws, std::runtime_error.
  Taps(const Run& run, const FrameOfRun& frame);

  /// By setting "node.param=value" instead of the run's: the node and what depends on it run again.
  /// Nothing where the value is not allowed.
  std::optional<Detections> rerun(const std::string& setting) const;

  /// A number that a node told ("noise_m"), or `otherwise`.
  double figure(const std::string& name, double otherwise = 0) const;

  const Run& run;
  SceneFile file;
  graph::Figures figures;
  std::vector<std::string> warnings;
  std::shared_ptr<const Cloud> cloud;
  std::shared_ptr<const FeatureSet> features;
  Scale scale;
  PerObject<Correspondences> correspondences;
  PerObject<VoteSet> votes;
  PerObject<VoteDensity> densities;
  Detections detections;

 private:
  graph::FrameContext listen();

  std::mutex telling_;
  std::unique_ptr<ablation::Replay> replay_;
};

}  // namespace posevote::explain
