// SPDX-License-Identifier: BSD-3-Clause
// A bumpy body in a scan, sought by the rules that the nodes have by default.
#pragma once

#include "nodes/poses/segment_params.hpp"
#include "tests/support/bumpy_scene.hpp"

namespace posevote::test {

/// Every point moved along its normal by a normal deviate of this deviation [m].
inline Cloud with_noise(Cloud cloud, float deviation) {
  std::mt19937 random(5);
  std::normal_distribution<float> deviate(0, deviation);
  for (Eigen::Index i = 0; deviation > 0 && i < cloud.points.rows(); ++i)
    cloud.points.row(i) += deviate(random) * cloud.normals.row(i);
  return cloud;
}

class SoughtBody {
 public:
  explicit SoughtBody(const std::vector<Placed>& bodies, int shape = 1, float noise = 0)
      : model(*bumpy_model(shape)),
        cloud(with_noise(scan_of(bodies), noise)),
        features(features_of(cloud)),
        scan(cloud, features, kResolution) {
    params.inlier_distance = 2;
  }

  poses::Sought sought() const {
    return {model,        scan, poses::instance_params(params, model, kResolution),
            params.terms, 0,    octaves_of(features)};
  }
  Hypothesis hypothesis(const Eigen::Isometry3d& T_scene_model, double support = 10) const {
    return hypothesis_of(T_scene_model, model.center, support);
  }
  poses::Candidate candidate(const Eigen::Isometry3d& T_scene_model, double support = 10) const {
    poses::Candidate one;
    one.proposed = hypothesis(T_scene_model, support);
    one.T_scene_model = T_scene_model;
    return one;
  }

  Model model;
  Cloud cloud;
  FeatureSet features;
  poses::ScanState scan;
  poses::SegmentParams params;
};

inline const Placed kBody{1, pose(-0.02, 0.01, 0.8, 0.7)};

/// The body's pose, moved to the right and turned.
inline Eigen::Isometry3d beside(double metres, double turn = 0) {
  Eigen::Isometry3d T = kBody.T_scene_model;
  T.translation().x() += metres;
  T.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d(1, -1, 0.5).normalized()));
  return T;
}

inline double distance_to_body(const Eigen::Isometry3d& T_scene_model) {
  return (T_scene_model.translation() - kBody.T_scene_model.translation()).norm();
}

}  // namespace posevote::test
