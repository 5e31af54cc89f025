// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's PPF3DDetector behind a wall: its headers stay in one file. Built only where OpenCV is.
#pragma once

#include <memory>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/data/features.hpp"
#include "nodes/data/hypotheses.hpp"

namespace posevote::adapters {

struct PpfTraining {
  double sampling = 0.05;  ///< spacing of the model's points, x diagonal
  double distance = 0.05;  ///< step of a pair's distance, x diagonal
  double angles = 30;      ///< steps of its angles in a full turn
};

struct PpfMatching {
  double reference_share = 0.2;    ///< of the sampled scene points, those that vote
  double cluster_distance = 0.05;  ///< poses nearer than this are one, x diagonal
  double cluster_angle = 12;       ///< and whose angles of rotation differ by less [deg]
};

class PpfDetector {
 public:
  /// Throws std::runtime_error where the cloud is flat along an axis or gives too many points.
  PpfDetector(const Cloud& model, const PpfTraining& training);
  ~PpfDetector();
  PpfDetector(const PpfDetector&) = delete;
  PpfDetector& operator=(const PpfDetector&) = delete;

  /// Poses in descending order of votes. Safe from many threads, which wait for each other.
  std::vector<Hypothesis> match(const FeatureSet& scene, const PpfMatching& matching,
                                const Eigen::Vector3f& model_center) const;

 private:
  struct OpenCv;
  std::unique_ptr<OpenCv> opencv_;
  double sampling_, diagonal_;
};

}  // namespace posevote::adapters
