// SPDX-License-Identifier: BSD-3-Clause
// Matches every feature of the scene to the nearest descriptor of all models: it votes for the one
// object that owns that descriptor (Buch, Kiforenko, Kraft, ICCV 2017, multi-object recognition).
// Each correspondence carries the ratio of the squared distances to the nearest and
// the second nearest descriptor, the authors' own match score: 0 is distinctive, 1 is a coin toss
// (0/0 counts as 1). Where features carry several descriptors (fuse_features), each is searched
// by itself and the one with the smallest ratio decides (of equal ratios the first); `distance` is
// then that descriptor's.
//
// One slot a model, in library order, possibly empty. Fails where the scene's descriptors are of
// another length than the library's, or fused otherwise. Time: that of
// DescriptorIndex::nearest_two.
//
//   match_features: {in: [scene_features, library], out: correspondences, max_ratio: 1}
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"
#include "nodes/descriptors/descriptor_index.hpp"

namespace posevote::match {
namespace {

struct Params {
  double max_ratio = 1;
  double max_distance = 0;
};

/// First row of each model in the index, and the end.
std::vector<std::uint32_t> first_rows(const ModelLibrary& library) {
  std::vector<std::uint32_t> first{0};
  for (const auto& model : library.models)
    first.push_back(first.back() + static_cast<std::uint32_t>(model->features.descriptors.rows()));
  return first;
}

PerObject<Correspondences> match_features(const FeatureSet& scene, const ModelLibrary& library,
                                          const Params& params) {
  if (!library.index) throw std::runtime_error("the model library has no index");
  const std::vector<descriptors::TwoNearest> nearest =
      library.index->nearest_two(scene.descriptors, scene.blocks);
  const std::vector<std::uint32_t> first = first_rows(library);
  std::vector<Correspondences> matches(library.models.size());
  for (std::size_t i = 0; i < matches.size(); ++i) matches[i].model = library.models[i];
  for (std::size_t feature = 0; feature < nearest.size(); ++feature) {
    const float ratio = descriptors::squared_ratio(nearest[feature]);
    const float distance = std::sqrt(nearest[feature].squared[0]);
    if (ratio > static_cast<float>(params.max_ratio)) continue;
    if (params.max_distance > 0 && distance > static_cast<float>(params.max_distance)) continue;
    const std::uint32_t row = nearest[feature].row[0];
    const auto owner = std::upper_bound(first.begin(), first.end(), row) - first.begin() - 1;
    Correspondences& votes = matches[static_cast<std::size_t>(owner)];
    votes.scene_feature.push_back(static_cast<std::uint32_t>(feature));
    votes.model_feature.push_back(row - first[static_cast<std::size_t>(owner)]);
    votes.distance.push_back(distance);
    votes.ratio.push_back(ratio);
  }
  PerObject<Correspondences> correspondences;
  for (Correspondences& votes : matches)
    correspondences.slots.push_back(std::make_shared<const Correspondences>(std::move(votes)));
  return correspondences;
}

const auto registered =
    graph::register_node("match_features", match_features,
                         "The nearest model descriptor of every scene descriptor.")
        .input("scene_features")
        .input("library")
        .output("correspondences")
        .param("max_ratio", &Params::max_ratio, "",
               "Largest squared distance of the nearest over the second nearest; 1 keeps all.",
               graph::in_range(0, 1))
        .param("max_distance", &Params::max_distance, "descriptor distance",
               "Largest distance of a match; 0 keeps all.", graph::at_least(0));

}  // namespace
}  // namespace posevote::match
