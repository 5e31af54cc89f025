// SPDX-License-Identifier: BSD-3-Clause
// A trained object model, and the library of all models that scenes are matched against.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "nodes/data/features.hpp"

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

/// What find_near_symmetries finds.
struct NearSymmetries {
  std::vector<NearSymmetry> items;
};

namespace descriptors {
class DescriptorIndex;
}

/// Where a model's surfaces end (find_outline): a bit for each direction around a point.
struct Outline {
  float reach = 0;                 ///< how far ahead was looked [m]
  std::vector<std::uint8_t> ends;  ///< per point of the model's cloud
};

/// One object, preprocessed and described.
struct Model {
  std::string name;
  int obj_id = 1;
  Cloud cloud;          ///< downsampled, outward unit normals, in the model's own frame
  FeatureSet features;  ///< of a uniform subset of the cloud
  Eigen::Vector3f center =
      Eigen::Vector3f::Zero();  ///< centre c of the full model's bounding box [m]
  float diagonal = 0;           ///< of that bounding box [m]
  NearSymmetries near_symmetries;
  Outline outline;
};

/// A model that could not be trained.
struct LeftOutModel {
  std::string name;
  int obj_id = 1;
  std::string why;  ///< "node: cause"
};

/// All models of a run. Matching searches one index that holds every model's descriptors.
struct ModelLibrary {
  std::vector<std::shared_ptr<const Model>> models;  ///< ascending obj_id
  Scale scale;
  std::shared_ptr<const descriptors::DescriptorIndex> index;
  std::vector<LeftOutModel> left_out{};  ///< asked for, but not here
};

/// The model of that obj_id, or null.
inline const Model* find_model(const ModelLibrary& library, int obj_id) {
  for (const auto& model : library.models)
    if (model->obj_id == obj_id) return model.get();
  return nullptr;
}

}  // namespace posevote
