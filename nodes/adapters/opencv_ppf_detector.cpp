// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/adapters/opencv_ppf_detector.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <mutex>
#include <opencv2/surface_matching/ppf_helpers.hpp>
#include <opencv2/surface_matching/ppf_match_3d.hpp>
#include <optional>
#include <stdexcept>
#include <string>

namespace posevote::adapters {
namespace {

namespace ppf = cv::ppf_match_3d;

constexpr int kMostPoints = 3000;          // OpenCV keeps some 70 bytes for each pair of them
constexpr double kFinestGrid = 1.0 / 160;  // OpenCV keeps 24 bytes a cell, empty or not

/// n x 6, each row a point and its normal; rows that are not usable are left out.
cv::Mat to_opencv(const PointMatrix& points, const PointMatrix& normals) {
  cv::Mat rows(0, 6, CV_32F);
  rows.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3f p = points.row(i), n = normals.row(i);
    if (!p.allFinite() || !n.allFinite() || !(n.squaredNorm() > 0.5F)) continue;
    rows.push_back(cv::Mat(cv::Matx<float, 1, 6>(p.x(), p.y(), p.z(), n.x(), n.y(), n.z())));
  }
  return rows;
}

struct Box {
  cv::Vec2f x, y, z;

  explicit Box(const cv::Mat& cloud) {
    double low = 0, high = 0;
    int axis = 0;
    for (cv::Vec2f* range : {&x, &y, &z}) {
      if (!cloud.empty()) cv::minMaxIdx(cloud.col(axis++), &low, &high);
      *range = {static_cast<float>(low), static_cast<float>(high)};
    }
  }
  Eigen::Vector3d extent() const {
    return Eigen::Vector3f(x[1] - x[0], y[1] - y[0], z[1] - z[0]).cast<double>();
  }
  /// OpenCV divides by each extent, and indexes by what comes of it.
  bool is_flat() const { return !(extent().minCoeff() > 1e-6 * extent().maxCoeff()); }
};

/// OpenCV averages quaternions and leaves them as short as they come out, so its matrices scale.
std::optional<Eigen::Isometry3d> rigid(const ppf::Pose3D& pose) {
  // OpenCV's quaternion is that of the transposed matrix.
  const Eigen::Quaterniond q(pose.q[0], -pose.q[1], -pose.q[2], -pose.q[3]);
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  T_scene_model.translation() << pose.t[0], pose.t[1], pose.t[2];
  if (!(q.norm() > 1e-3) || !q.coeffs().allFinite() || !T_scene_model.matrix().allFinite())
    return std::nullopt;
  T_scene_model.linear() = q.normalized().toRotationMatrix();
  return T_scene_model;
}

}  // namespace

/// OpenCV's matching writes members, so callers take turns.
struct PpfDetector::OpenCv {
  ppf::PPF3DDetector detector;
  std::mutex turn;

  explicit OpenCv(const PpfTraining& training)
      : detector(training.sampling, training.distance, training.angles) {}
};

PpfDetector::PpfDetector(const Cloud& model, const PpfTraining& training)
    : opencv_(std::make_unique<OpenCv>(training)), sampling_(training.sampling), diagonal_(0) {
  const cv::Mat cloud = to_opencv(model.points, model.normals);
  Box box(cloud);
  if (box.is_flat())
    throw std::runtime_error("has no extent along an axis: OpenCV cannot sample it");
  diagonal_ = box.extent().norm();
  const int points = ppf::samplePCByQuantization(cloud, box.x, box.y, box.z,
                                                 static_cast<float>(training.sampling), 0)
                         .rows;
  if (points > kMostPoints)
    throw std::runtime_error("gives " + std::to_string(points) + " points, expected at most " +
                             std::to_string(kMostPoints) + ": sampling is too fine for it");
  opencv_->detector.trainModel(cloud);
}

PpfDetector::~PpfDetector() = default;

std::vector<Hypothesis> PpfDetector::match(const FeatureSet& scene, const PpfMatching& matching,
                                           const Eigen::Vector3f& model_center) const {
  const cv::Mat cloud = to_opencv(scene.points, scene.normals);
  const Box box(cloud);
  if (box.is_flat()) return {};
  // Documented as relative to the model, but OpenCV takes it of the scene: keep the model's
  // spacing.
  const double spacing = std::clamp(sampling_ * diagonal_ / box.extent().norm(), kFinestGrid, 1.0);
  std::vector<ppf::Pose3DPtr> poses;
  {
    const std::lock_guard lock(opencv_->turn);
    opencv_->detector.setSearchParams(matching.cluster_distance * diagonal_, matching.cluster_angle,
                                      true);
    opencv_->detector.match(cloud, poses, matching.reference_share, spacing);
  }
  std::vector<Hypothesis> found;
  for (const ppf::Pose3DPtr& pose : poses)
    if (const auto T_scene_model = rigid(*pose); T_scene_model && pose->numVotes > 0)
      found.push_back(
          hypothesis_of(*T_scene_model, model_center, static_cast<double>(pose->numVotes)));
  sort_by_support(found);
  return found;
}

}  // namespace posevote::adapters
