// SPDX-License-Identifier: BSD-3-Clause
// Puts the trained models together and builds the one index over all their descriptors, so that
// each scene feature can vote for exactly one object (Buch, Kiforenko, Kraft, ICCV 2017,
// multi-object recognition). How the index is searched belongs to the library and not to matching:
// see descriptor_index.hpp.
//
// The centre c and the diagonal of a model are those of the bounding box of its full mesh, so they
// do not depend on the sampling.
//
// Fails where two models have the same obj_id, or descriptors differ in length. Time: O(size).
//
//   assemble_library: {in: [model_files, model_meshes, model_clouds, model_features,
//                           near_symmetries, outlines, scale], out: library, search: exact}
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "graph/registry.hpp"
#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "nodes/descriptors/descriptor_index.hpp"

namespace posevote::train {
namespace {

using Params = descriptors::IndexOptions;

Model assemble_model(const ModelFile& file, const Mesh& mesh, const Cloud& cloud,
                     const FeatureSet& features, const NearSymmetries& near_symmetries,
                     const Outline& outline) {
  if (mesh.points.rows() == 0) throw std::runtime_error(file.path.string() + ": has no points");
  Model model;
  model.name = file.name;
  model.obj_id = file.obj_id;
  model.cloud = cloud;
  model.features = features;
  const Eigen::RowVector3f low = mesh.points.colwise().minCoeff();
  const Eigen::RowVector3f high = mesh.points.colwise().maxCoeff();
  model.center = (0.5F * (low + high)).transpose();
  model.diagonal = (high - low).norm();
  model.near_symmetries = near_symmetries;
  model.outline = outline;
  return model;
}

void require_distinct_ids(const ModelLibrary& library) {
  for (std::size_t i = 1; i < library.models.size(); ++i) {
    const Model& a = *library.models[i - 1];
    const Model& b = *library.models[i];
    if (a.obj_id == b.obj_id)
      throw std::runtime_error("models '" + a.name + "' and '" + b.name +
                               "' have the same obj_id " + std::to_string(a.obj_id));
  }
}

ModelLibrary assemble_library(const ModelFiles& files, const PerObject<Mesh>& meshes,
                              const PerObject<Cloud>& clouds, const PerObject<FeatureSet>& features,
                              const PerObject<NearSymmetries>& near_symmetries,
                              const PerObject<Outline>& outlines, const Scale& scale,
                              const Params& params) {
  const std::size_t count = files.size();
  if (count == 0) throw std::runtime_error("there are no models");
  if (meshes.size() != count || clouds.size() != count || features.size() != count ||
      near_symmetries.size() != count || outlines.size() != count)
    throw std::runtime_error(
        std::to_string(count) + " model files, but " + std::to_string(meshes.size()) + " meshes, " +
        std::to_string(clouds.size()) + " clouds, " + std::to_string(features.size()) +
        " feature sets, " + std::to_string(near_symmetries.size()) +
        " lists of near symmetries and " + std::to_string(outlines.size()) + " outlines");
  ModelLibrary library;
  library.scale = scale;
  for (std::size_t i = 0; i < count; ++i)
    library.models.push_back(std::make_shared<const Model>(assemble_model(
        files[i], meshes[i], clouds[i], features[i], near_symmetries[i], outlines[i])));
  std::stable_sort(library.models.begin(), library.models.end(),
                   [](const auto& a, const auto& b) { return a->obj_id < b->obj_id; });
  require_distinct_ids(library);
  library.index = descriptors::index_of(library.models, params);
  return library;
}

const auto registered =
    graph::register_node("assemble_library", assemble_library,
                         "The models and one index over the descriptors of all of them.")
        .input("model_files")
        .input("model_meshes")
        .input("model_clouds")
        .input("model_features")
        .input("near_symmetries")
        .input("outlines")
        .input("scale")
        .output("library")
        .param("search", &Params::search, "",
               "How matching searches: exact and fast, exact by FLANN's k-d tree, or by FLANN's "
               "randomised trees, whose matches differ from run to run.",
               graph::one_of({"exact", "kd_tree", "approximate"}))
        .param("trees", &Params::trees, "", "Search approximate: randomised trees.",
               graph::in_range(1, 64))
        .param("checks", &Params::checks, "", "Search approximate: descriptors compared per query.",
               graph::at_least(2));

}  // namespace
}  // namespace posevote::train
