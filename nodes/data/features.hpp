// SPDX-License-Identifier: BSD-3-Clause
// Feature points, their descriptors, and the correspondences that matching finds between them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// The one length that all others follow: how far apart the points of a run are. Descriptors agree
/// only where models and scans are sampled alike, so radii and distances of the nodes are multiples
/// of it ("x resolution"), as in the authors' own code.
struct Scale {
  float resolution = 0;  ///< edge of the voxel grid [m]
};

/// Indices into a cloud: the points that get a descriptor.
struct FeaturePoints {
  std::vector<std::uint32_t> indices;
};

/// n x d, one descriptor a row.
using DescriptorMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Oriented feature points and their descriptors; row i of each belongs together.
struct FeatureSet {
  PointMatrix points;            ///< n x 3 [m]
  PointMatrix normals;           ///< n x 3 unit
  DescriptorMatrix descriptors;  ///< n x d, compared by the Euclidean distance
  /// Several descriptors side by side, each compared by itself: their numbers of columns, of sum d.
  /// Empty: one descriptor.
  std::vector<std::uint32_t> blocks;
};

struct Model;

/// Matches of one object's features in one scene, scene to model, in ascending order of
/// scene_feature.
struct Correspondences {
  std::shared_ptr<const Model> model;
  std::vector<std::uint32_t> scene_feature;  ///< row of the scene's FeatureSet
  std::vector<std::uint32_t> model_feature;  ///< row of the model's FeatureSet
  std::vector<float> distance;               ///< Euclidean descriptor distance
  std::vector<float> ratio;  ///< squared distance of nearest over second nearest, in [0, 1]
};

}  // namespace posevote
