// SPDX-License-Identifier: BSD-3-Clause
// Puts the trained models together, each with all its octaves (derive_scale.cpp says in which
// order they come), and builds for each octave one index over the descriptors of all models, so that
// each scene feature can vote for exactly one object (Buch, Kiforenko, Kraft, ICCV 2017,
// multi-object recognition). How the index is searched belongs to the library and not to matching:
// see descriptor_index.hpp.
//
// The centre c and the diagonal of a model are those of the bounding box of its full mesh, so they
// do not depend on the sampling.
//
// Fails where two models have the same obj_id, or descriptors differ in length. Time: O(size).
//
//   assemble_library: {in: [model_files, octave_meshes, model_clouds, model_features,
//                           symmetries, near_symmetries, outlines, octaves], out: library, search: exact}
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/descriptors/octaves.hpp"
#include "nodes/pairs/pair_table.hpp"

namespace posevote::train {
namespace {

struct Params : descriptors::IndexOptions {
  double pair_step = 0.07;
  double rim_step = 0.025;
};

/// What training made of one model at one octave.
struct Part {
  const Cloud& cloud;
  std::shared_ptr<const FeatureSet> features;
  const Symmetries& symmetries;        ///< of the finest
  const Symmetries& shape_symmetries;  ///< of this octave
  const NearSymmetries& near_symmetries;
  const Outline& outline;
  const Scale& scale;
};

/// A model at one octave, without features.
Model shape_of(const ModelFile& file, const Mesh& mesh, const Part& part) {
  Model model;
  model.name = file.name;
  model.obj_id = file.obj_id;
  model.resolution = part.scale.resolution;
  model.cloud = part.cloud;
  const Eigen::RowVector3f low = mesh.points.colwise().minCoeff();
  const Eigen::RowVector3f high = mesh.points.colwise().maxCoeff();
  model.center = (0.5F * (low + high)).transpose();
  model.diagonal = (high - low).norm();
  model.symmetries = file.symmetries.value_or(part.symmetries);
  model.shape_symmetries = part.shape_symmetries;
  model.near_symmetries = part.near_symmetries;
  model.outline = part.outline;
  return model;
}

/// `octaves`: ascending.
Model assemble_model(const ModelFile& file, const Mesh& mesh, const std::vector<Part>& octaves,
                     const Params& params) {
  if (mesh.points.rows() == 0) throw std::runtime_error(file.path.string() + ": has no points");
  Model model = shape_of(file, mesh, octaves.at(0));
  for (std::size_t k = 1; k < octaves.size(); ++k)
    model.coarser.push_back(std::make_shared<const Model>(shape_of(file, mesh, octaves[k])));
  std::vector<std::shared_ptr<const FeatureSet>> features;
  std::vector<Scale> scales;
  for (const Part& part : octaves) {
    features.push_back(part.features);
    scales.push_back(part.scale);
  }
  model.features = descriptors::stack_octaves(features, scales);
  model.pairs = pairs::index_pairs(model, static_cast<float>(params.pair_step) * model.diagonal);
  model.rims = pairs::index_rims(model, static_cast<float>(params.rim_step) * model.diagonal);
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

/// A model that nothing could match is named, so that the others can go on without it.
void require_features(const ModelLibrary& library) {
  const std::string why =
      "none of its feature points has enough neighbours and a normal to be described";
  std::vector<graph::ObjectFailure> failed;
  std::string all;
  for (std::size_t i = 0; i < library.models.size(); ++i) {
    if (library.models[i]->features.points.rows() > 0) continue;
    failed.push_back({i, why});
    all += (all.empty() ? "" : "; ") + library.models[i]->name + ": " + why;
  }
  if (!failed.empty()) throw graph::ObjectErrors(failed, all);
}

void require_slots(std::size_t models, std::size_t octaves, const std::vector<std::size_t>& sizes) {
  if (models == 0) throw std::runtime_error("there are no models");
  for (const std::size_t size : sizes)
    if (size != octaves || size == 0 || size % models != 0)
      throw std::runtime_error(std::to_string(models) + " model files in " +
                               std::to_string(octaves) + " octaves, but " + std::to_string(size) +
                               " results of training");
}

ModelLibrary assemble_library(const ModelFiles& files, const PerObject<Mesh>& meshes,
                              const PerObject<Cloud>& clouds, const PerObject<FeatureSet>& features,
                              const PerObject<Symmetries>& symmetries,
                              const PerObject<NearSymmetries>& near_symmetries,
                              const PerObject<Outline>& outlines, const PerObject<Scale>& octaves,
                              const Params& params) {
  const std::size_t count = files.size();
  require_slots(count, octaves.size(),
                {meshes.size(), clouds.size(), features.size(), symmetries.size(),
                 near_symmetries.size(), outlines.size()});
  ModelLibrary library;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Part> parts;
    for (std::size_t slot = i; slot < octaves.size(); slot += count)
      parts.push_back({clouds[slot], features.slots[slot], symmetries[i], symmetries[slot],
                       near_symmetries[slot], outlines[slot], octaves[slot]});
    library.models.push_back(
        std::make_shared<const Model>(assemble_model(files[i], meshes[i], parts, params)));
  }
  require_features(library);  // before they are sorted: by the order of the files
  std::stable_sort(library.models.begin(), library.models.end(),
                   [](const auto& a, const auto& b) { return a->obj_id < b->obj_id; });
  require_distinct_ids(library);
  library.octaves = descriptors::index_octaves(library.models, params);
  return library;
}

const auto registered =
    graph::register_node("assemble_library", assemble_library,
                         "The models and one index over the descriptors of all of them.")
        .input("model_files")
        .input("octave_meshes")
        .input("model_clouds")
        .input("model_features")
        .input("symmetries")
        .input("near_symmetries")
        .input("outlines")
        .input("octaves")
        .output("library")
        .param("pair_step", &Params::pair_step, "x diagonal",
               "How far apart the points of cast_pairs are.", graph::in_range(0.02, 0.5))
        .param("rim_step", &Params::rim_step, "x diagonal",
               "How far apart the points of cast_rims are.", graph::in_range(0.02, 0.5))
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
