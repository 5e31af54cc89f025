// SPDX-License-Identifier: BSD-3-Clause
// Models whose descriptors are one number each, so that matches can be read off.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::test {

inline FeatureSet features_at(const std::vector<float>& values) {
  FeatureSet features;
  const auto count = static_cast<Eigen::Index>(values.size());
  features.points.setConstant(count, 3, 0.25F);
  features.normals = PointMatrix::Ones(count, 3).rowwise().normalized();
  features.descriptors = Eigen::Map<const Eigen::VectorXf>(values.data(), count);
  return features;
}

inline Cloud box_cloud(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  Cloud cloud;
  cloud.points.resize(3, 3);
  cloud.points.row(0) = low.transpose();
  cloud.points.row(1) = high.transpose();
  cloud.points.row(2) = (0.3F * low + 0.7F * high).transpose();
  cloud.normals = PointMatrix::Ones(3, 3).rowwise().normalized();
  return cloud;
}

/// One model for each list of values, with the obj_ids 1, 2, ... unless given.
inline ModelLibrary make_library(const std::vector<std::vector<float>>& values,
                                 const std::map<std::string, std::string>& params = {},
                                 std::vector<int> obj_ids = {}) {
  ModelFiles files;
  PerObject<Mesh> meshes;
  PerObject<Cloud> clouds;
  PerObject<FeatureSet> features;
  PerObject<Symmetries> symmetries;
  PerObject<NearSymmetries> near_symmetries;
  PerObject<Outline> outlines;
  PerObject<Scale> octaves;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int id = obj_ids.empty() ? static_cast<int>(i) + 1 : obj_ids[i];
    files.push_back({"m" + std::to_string(id) + ".ply", id, "m" + std::to_string(id)});
    const Cloud cloud = box_cloud({0, 0, 0}, {1, static_cast<float>(id), 2});
    meshes.slots.push_back(std::make_shared<const Mesh>(Mesh{cloud.points, {}, {}}));
    clouds.slots.push_back(std::make_shared<const Cloud>(cloud));
    features.slots.push_back(std::make_shared<const FeatureSet>(features_at(values[i])));
    symmetries.slots.push_back(std::make_shared<const Symmetries>(
        Symmetries{{0.5F, 0, static_cast<float>(id)},
                   {Eigen::Quaternionf::Identity(), {0, 1, 0, 0}},
                   {Eigen::Vector3f::UnitZ()}}));
    near_symmetries.slots.push_back(std::make_shared<const NearSymmetries>(NearSymmetries{
        {{Eigen::Isometry3d(Eigen::AngleAxisd(id, Eigen::Vector3d::UnitZ())), {0, 2}, {1}}}}));
    outlines.slots.push_back(
        std::make_shared<const Outline>(Outline{0.01F, {1, 2, 4}, 0.005F, {1, 3, 4}}));
    octaves.slots.push_back(std::make_shared<const Scale>(Scale{0.002F}));
  }
  return run_node<ModelLibrary>("assemble_library", params, files, meshes, clouds, features,
                                symmetries, near_symmetries, outlines, octaves);
}

}  // namespace posevote::test
