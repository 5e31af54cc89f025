// SPDX-License-Identifier: BSD-3-Clause
// 3D Hough voting (Tombari, Di Stefano 2010; PCL's code): with a local reference frame at both ends
// a correspondence votes for one place of the model's centroid; the correspondences in a peak of
// the Hough space give a pose.
//
// Frames are SHOT's, over the preprocessed clouds. A correspondence without a frame at either end
// casts no vote. O(features x neighbours + correspondences).
//
//   hough3d: {in: [correspondences, scene_features, scene_cloud, scale], out: hypotheses}
#include <pcl/features/shot_lrf.h>
#include <pcl/recognition/cg/hough_3d.h>

#include <cmath>

#include "graph/registry.hpp"
#include "nodes/adapters/pcl_grouping.hpp"
#include "nodes/adapters/pcl_surface.hpp"

namespace posevote::baseline {
namespace {

struct Params {
  double bin = 5;
  double threshold = 5;
  double frame_radius = 15;
};

using PclPoints = pcl::PointCloud<pcl::PointXYZ>;
using Frames = pcl::PointCloud<pcl::ReferenceFrame>;

PclPoints::Ptr to_pcl(const PointMatrix& points) {
  PclPoints::Ptr cloud(new PclPoints);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    cloud->emplace_back(points(i, 0), points(i, 1), points(i, 2));
  return cloud;
}

/// A frame for each feature point; not finite where the surface gives none.
Frames frames_at(const PointMatrix& features, const Cloud& surface, double radius) {
  pcl::SHOTLocalReferenceFrameEstimation<pcl::PointXYZ, pcl::ReferenceFrame> estimation;
  estimation.setInputCloud(to_pcl(features));
  estimation.setSearchSurface(to_pcl(surface.points));
  estimation.setRadiusSearch(radius);
  Frames frames;
  estimation.compute(frames);
  return frames;
}

bool is_finite(const pcl::ReferenceFrame& frame) {
  return std::isfinite(frame.x_axis[0]) && std::isfinite(frame.y_axis[0]) &&
         std::isfinite(frame.z_axis[0]);
}

/// The correspondences that have a frame at both ends.
Correspondences with_frames(const Correspondences& matches, const Frames& model,
                            const Frames& scene) {
  Correspondences kept{matches.model, {}, {}, {}, {}};
  for (std::size_t i = 0; i < matches.scene_feature.size(); ++i) {
    if (!is_finite(model[matches.model_feature[i]]) || !is_finite(scene[matches.scene_feature[i]]))
      continue;
    kept.scene_feature.push_back(matches.scene_feature[i]);
    kept.model_feature.push_back(matches.model_feature[i]);
    kept.distance.push_back(matches.distance[i]);
    kept.ratio.push_back(matches.ratio[i]);
  }
  return kept;
}

Frames::Ptr choose(const Frames& frames, const std::vector<std::uint32_t>& features) {
  Frames::Ptr chosen(new Frames);
  for (const std::uint32_t feature : features) chosen->push_back(frames[feature]);
  return chosen;
}

Hypotheses hough3d(const Correspondences& all, const FeatureSet& scene, const Cloud& scene_cloud,
                   const Scale& scale, const Params& params) {
  if (all.scene_feature.size() < 3) return {all.model, {}};
  const double radius = params.frame_radius * static_cast<double>(scale.resolution);
  const Frames model_frames = frames_at(all.model->features.points, all.model->cloud, radius);
  const Frames scene_frames = frames_at(scene.points, scene_cloud, radius);
  const Correspondences matches = with_frames(all, model_frames, scene_frames);
  if (matches.scene_feature.size() < 3) return {all.model, {}};
  const adapters::PclPairs pairs = adapters::make_pcl_pairs(matches, scene);
  pcl::Hough3DGrouping<pcl::PointXYZ, pcl::PointXYZ> grouping;
  grouping.setHoughBinSize(params.bin * static_cast<double>(scale.resolution));
  grouping.setHoughThreshold(params.threshold);
  grouping.setUseInterpolation(true);
  grouping.setUseDistanceWeight(false);
  grouping.setInputCloud(pairs.model);
  grouping.setInputRf(choose(model_frames, matches.model_feature));
  grouping.setSceneCloud(pairs.scene);
  grouping.setSceneRf(choose(scene_frames, matches.scene_feature));
  return group(grouping, pairs, matches);
}

const auto registered =
    graph::register_node(
        "hough3d", hough3d,
        "Rival: poses of correspondences that agree on where the model's centre is.")
        .input("correspondences")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("hypotheses")
        .param("bin", &Params::bin, "x resolution", "Edge of a cell of the Hough space.",
               graph::greater_than(0))
        .param("threshold", &Params::threshold, "votes", "A peak of fewer votes gives no pose.",
               graph::at_least(1))
        .param("frame_radius", &Params::frame_radius, "x resolution",
               "Neighbourhood of a local reference frame.", graph::greater_than(0));

}  // namespace
}  // namespace posevote::baseline
