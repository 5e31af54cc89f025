// SPDX-License-Identifier: BSD-3-Clause
// Feature points, their descriptors, and the correspondences that matching finds between them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// The length that all others follow: how far apart the points of a cloud are. Descriptors agree
/// only where models and scans are sampled alike, so radii and distances of the nodes are multiples
/// of it ("x resolution"), as in the authors' own code. An object is described at several of them,
/// its octaves, each twice the one before, and a scan at those that its objects have in common.
struct Scale {
  float resolution = 0;  ///< edge of the voxel grid [m]
};

/// Indices into a cloud: the points that get a descriptor.
struct FeaturePoints {
  std::vector<std::uint32_t> indices;
};

/// n x d, one descriptor a row.
using DescriptorMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Such rows where they lie, of a whole matrix or of a part of one: nothing is copied.
using DescriptorRows = Eigen::Ref<const DescriptorMatrix>;

/// Rows of a FeatureSet that were described at one scale.
struct Octave {
  float resolution = 0;              ///< [m]; compared exactly: octaves are powers of two
  std::uint32_t begin = 0, end = 0;  ///< rows
  /// Of these rows, where sets were joined: what describes a large scan is not copied.
  std::shared_ptr<const DescriptorMatrix> descriptors = nullptr;
};

/// Oriented feature points and their descriptors; row i of each belongs together.
struct FeatureSet {
  PointMatrix points;   ///< n x 3 [m]
  PointMatrix normals;  ///< n x 3 unit
  /// n x d, compared by the Euclidean distance; empty where the octaves have their own
  DescriptorMatrix descriptors;
  /// Several descriptors side by side, each compared by itself: their numbers of columns, of sum d.
  /// Empty: one descriptor.
  std::vector<std::uint32_t> blocks;
  /// All rows, in ascending order of resolution; empty: one octave, of no matter what scale.
  std::vector<Octave> octaves;
};

/// Whether two octaves are of one scale.
inline bool same_scale(const Octave& a, float resolution) {
  return a.resolution == resolution || a.resolution == 0 || resolution == 0;
}

/// The octaves, of which there always is one.
inline std::vector<Octave> octaves_of(const FeatureSet& features) {
  if (!features.octaves.empty()) return features.octaves;
  return {{0, 0, static_cast<std::uint32_t>(features.points.rows())}};
}

/// The descriptors of an octave of theirs.
inline DescriptorRows descriptors_of(const FeatureSet& features, const Octave& octave) {
  if (octave.descriptors) return *octave.descriptors;
  return features.descriptors.middleRows(octave.begin, octave.end - octave.begin);
}

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
