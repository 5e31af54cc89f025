// SPDX-License-Identifier: BSD-3-Clause
// A trained object model, and the library of all models that scenes are matched against.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "nodes/data/face_ends.hpp"
#include "nodes/data/features.hpp"
#include "nodes/data/symmetries.hpp"

namespace posevote {

/// A motion in the model's own frame that carries it nearly onto itself. Where the two differ are
/// points of the model's cloud.
struct NearSymmetry {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  std::vector<std::uint32_t> carried_off;  ///< those that the motion carries off the surface
  std::vector<std::uint32_t> uncovered;    ///< those onto which it carries nothing

  /// Whether a cloud of that many points has them all.
  bool is_within(Eigen::Index points) const {
    const auto there = [points](std::uint32_t i) { return i < points; };
    return std::all_of(carried_off.begin(), carried_off.end(), there) &&
           std::all_of(uncovered.begin(), uncovered.end(), there);
  }
};

/// What find_symmetries finds.
struct NearSymmetries {
  std::vector<NearSymmetry> items;
};

namespace descriptors {
class DescriptorIndex;
}
namespace pairs {
class PairTable;
}

/// Where a model's surfaces end (find_outline): per point of its cloud, a bit for each direction in
/// which it is no more; and where they bend.
struct Outline {
  float reach = 0;                   ///< how far ahead was looked for ends [m]
  std::vector<std::uint8_t> ends{};  ///< of the body
  float gap_reach = 0;               ///< the same, for gaps
  std::vector<std::uint8_t> gaps{};  ///< holes, slots, teeth, and where the body ends
  Eigen::Matrix3Xf hull{};           ///< 3 x N, the outermost points
  /// Per point of its cloud the nearest one around a bend; itself where there is none. Empty: unknown.
  std::vector<std::uint32_t> bends{};
};

/// One object, preprocessed and described. Its cloud, near symmetries and outline belong together.
struct Model {
  std::string name;
  int obj_id = 1;
  float resolution = 0;  ///< of the cloud [m]
  Cloud cloud;           ///< downsampled, outward unit normals, in the model's own frame
  FeatureSet features;   ///< of uniform subsets of the clouds of all octaves
  Eigen::Vector3f center =
      Eigen::Vector3f::Zero();  ///< centre c of the full model's bounding box [m]
  float diagonal = 0;           ///< of that bounding box [m]
  Symmetries symmetries;        ///< of the finest alone
  Symmetries
      shape_symmetries;  ///< as far as this octave resolves the shape: what only colours tell
  NearSymmetries near_symmetries;
  Outline outline;
  std::shared_ptr<const pairs::PairTable> pairs;  ///< of the finest alone
  std::shared_ptr<const pairs::PairTable> rims;   ///< likewise
  /// The same object at its next octaves, ascending; the features are all in the finest.
  std::vector<std::shared_ptr<const Model>> coarser;
  KnownFaceEnds face_ends;

  /// The finest that is not finer than a scan, or the coarsest: scans are judged by it.
  const Model& at(float scan_resolution) const {
    const Model* best = this;
    for (const auto& next : coarser)
      if (best->resolution < scan_resolution) best = next.get();
    return *best;
  }
};

/// A model that could not be trained.
struct LeftOutModel {
  std::string name;
  int obj_id = 1;
  std::string why;  ///< "node: cause"
};

/// Some of a model's features in an index.
struct IndexedRows {
  std::uint32_t model = 0;  ///< number in the library
  std::uint32_t begin = 0;  ///< first row of its FeatureSet
  std::uint32_t first = 0;  ///< that row in the index
};

/// The descriptors of all models at one scale; matching searches them together.
struct LibraryOctave {
  float resolution = 0;  ///< [m]
  std::shared_ptr<const descriptors::DescriptorIndex> index;
  std::vector<IndexedRows> rows;  ///< ascending
};

/// All models of a run.
struct ModelLibrary {
  std::vector<std::shared_ptr<const Model>> models;  ///< ascending obj_id, each at its finest
  std::vector<LibraryOctave> octaves;                ///< ascending resolution
  std::vector<LeftOutModel> left_out{};              ///< asked for, but not here
};

/// The model of that obj_id, or null.
inline const Model* find_model(const ModelLibrary& library, int obj_id) {
  for (const auto& model : library.models)
    if (model->obj_id == obj_id) return model.get();
  return nullptr;
}

}  // namespace posevote
