// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/scan_state.hpp"

#include <algorithm>

#include "nodes/data/hypotheses.hpp"
#include "nodes/poses/explain_points.hpp"

namespace posevote::poses {
namespace {

constexpr double kBelieved = 0.5;  // more likely there than not, whatever min_confidence is
constexpr float kSkin = 2;         // x resolution; so near a body others may come
constexpr float kSearchCell = 2;   // x resolution; of the index, changes no result

void extend(Eigen::AlignedBox3d& box, const PointMatrix& points, const std::vector<char>& chosen) {
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i] != 0)
      box.extend(
          Eigen::Vector3d(points.row(static_cast<Eigen::Index>(i)).transpose().cast<double>()));
}

}  // namespace

ScanState::ScanState(const Cloud& scan, const FeatureSet& scan_features, float resolution_m,
                     const Terms& terms, std::size_t kinds)
    : cloud(scan),
      features(scan_features),
      resolution(resolution_m),
      view(scan, resolution_m, terms.view),
      surface(scan, view.usable(), kSearchCell * resolution_m, terms.surface),
      ground(scan, kSkin * resolution_m),
      feature_explained(static_cast<std::size_t>(scan_features.points.rows()), 0),
      look(scan),
      known{kinds, {}} {}

void ScanState::take_out(const Model& model, const Eigen::Isometry3d& T_scene_model,
                         float distance) {
  ++takes;
  const geometry::SurfaceIndex index(model.cloud.points, distance);
  const std::vector<char> points =
      explain_points(model.cloud, index, T_scene_model, cloud.points, cloud.normals, distance);
  surface.take_out(points);
  const std::vector<char> now = explain_points(model.cloud, index, T_scene_model, features.points,
                                               features.normals, distance);
  for (std::size_t i = 0; i < now.size(); ++i)
    feature_explained[i] = static_cast<char>(feature_explained[i] | now[i]);
  Eigen::AlignedBox3d& gone = gone_.emplace_back();
  extend(gone, cloud.points, points);
  extend(gone, features.points, now);
}

bool ScanState::changed_since(int since, const Eigen::AlignedBox3d& box, double radius) const {
  return std::any_of(gone_.begin() + since, gone_.end(), [&](const Eigen::AlignedBox3d& gone) {
    return !gone.isEmpty() && gone.squaredExteriorDistance(box) <= radius * radius;
  });
}

void ScanState::learn_from(const Model& model, const Candidate& instance) {
  if (instance.confidence < kBelieved) return;
  known.found.push_back({model.obj_id, instance.confidence});
  usual_residual.add(instance.fit, range_of(model, instance.T_scene_model));
  usual_tint.add(instance.colors);
  solids_.emplace_back(model.cloud, instance.T_scene_model,
                       kSkin * std::max(resolution, model.resolution));
}

double ScanState::share_inside(const Model& model, const Eigen::Isometry3d& T_scene_model) const {
  double share = 0;
  for (const Solid& solid : solids_) share += solid.share_inside(model.cloud, T_scene_model);
  return std::min(share, 1.0);  // instances that overlap have some points both
}

double ScanState::range_of(const Model& model, const Eigen::Isometry3d& T_scene_model) const {
  return (posed_center(T_scene_model, model.center) - cloud.view.origin.cast<double>()).norm();
}

std::size_t ScanState::count_explained(const Model& model, const geometry::SurfaceIndex& index,
                                       const Eigen::Isometry3d& T_scene_model, float distance,
                                       const std::vector<Octave>& octaves) const {
  const std::vector<char> now = explain_points(model.cloud, index, T_scene_model, features.points,
                                               features.normals, distance);
  std::size_t count = 0;
  for (const Octave& rows : octaves)
    for (std::size_t i = rows.begin; i < rows.end; ++i)
      count += now[i] != 0 && feature_explained[i] == 0;
  return count;
}

}  // namespace posevote::poses
