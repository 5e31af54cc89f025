// SPDX-License-Identifier: BSD-3-Clause
// Matches every feature of the scene to the nearest descriptor of all models at the same scale: it
// votes for the one object that owns that descriptor (Buch, Kiforenko, Kraft, ICCV 2017,
// multi-object recognition). The octaves of a scan are matched one by one, and all matches of an
// object vote together: voting does not care where a correspondence comes from.
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
#include <iterator>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"
#include "nodes/descriptors/descriptor_index.hpp"

namespace posevote::match {
namespace {

struct Params {
  double max_ratio = 1;
  double max_distance = 0;
  int most = 0;
};

/// The matches of the scene's features at one scale, to be added to those of each model.
void match_octave(const FeatureSet& scene, const Octave& rows, const LibraryOctave& library,
                  const Params& params, std::vector<Correspondences>& matches) {
  const std::vector<descriptors::TwoNearest> nearest =
      library.index->nearest_two(descriptors_of(scene, rows), scene.blocks);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const float ratio = descriptors::squared_ratio(nearest[i]);
    const float distance = std::sqrt(nearest[i].squared[0]);
    if (ratio > static_cast<float>(params.max_ratio)) continue;
    if (params.max_distance > 0 && distance > static_cast<float>(params.max_distance)) continue;
    const std::uint32_t row = nearest[i].row[0];
    const auto behind = std::upper_bound(
        library.rows.begin(), library.rows.end(), row,
        [](std::uint32_t wanted, const IndexedRows& some) { return wanted < some.first; });
    const IndexedRows& owner = *std::prev(behind);
    Correspondences& votes = matches[owner.model];
    votes.scene_feature.push_back(rows.begin + static_cast<std::uint32_t>(i));
    votes.model_feature.push_back(owner.begin + row - owner.first);
    votes.distance.push_back(distance);
    votes.ratio.push_back(ratio);
  }
}

/// Keeps those of the smallest ratios, in their order; of equal ratios the first.
void keep_most_distinctive(Correspondences& votes, std::size_t most) {
  if (most == 0 || votes.ratio.size() <= most) return;
  std::vector<std::size_t> kept(votes.ratio.size());
  std::iota(kept.begin(), kept.end(), 0);
  const auto end = kept.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(kept.begin(), end, kept.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(votes.ratio[a], a) < std::pair(votes.ratio[b], b);
  });
  std::sort(kept.begin(), end);
  const auto keep = [&](auto& values) {
    for (std::size_t i = 0; i < most; ++i) values[i] = values[kept[i]];
    values.resize(most);
  };
  keep(votes.scene_feature);
  keep(votes.model_feature);
  keep(votes.distance);
  keep(votes.ratio);
}

PerObject<Correspondences> match_features(const FeatureSet& scene, const ModelLibrary& library,
                                          const Params& params) {
  if (library.octaves.empty()) throw std::runtime_error("the model library has no index");
  std::vector<Correspondences> matches(library.models.size());
  for (std::size_t i = 0; i < matches.size(); ++i) matches[i].model = library.models[i];
  for (const Octave& rows : octaves_of(scene))
    for (const LibraryOctave& octave : library.octaves)
      if (same_scale(rows, octave.resolution)) match_octave(scene, rows, octave, params, matches);
  PerObject<Correspondences> correspondences;
  for (Correspondences& votes : matches) {
    keep_most_distinctive(votes, static_cast<std::size_t>(params.most));
    correspondences.slots.push_back(std::make_shared<const Correspondences>(std::move(votes)));
  }
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
               "Largest distance of a match; 0 keeps all.", graph::at_least(0))
        .param("most", &Params::most, "",
               "Matches of an object at most, those of the smallest ratios, because the density's "
               "cost grows faster than their number; 0 keeps all.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote::match
