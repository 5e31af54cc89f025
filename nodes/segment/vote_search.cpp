// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/vote_search.hpp"

#include <algorithm>

#include "graph/parallel.hpp"
#include "nodes/density/refine_mode.hpp"

namespace posevote::segment {
namespace {

/// The scan's features at the scales at which a model was described.
std::vector<Octave> voters_for(const Model& model, const FeatureSet& scene_features) {
  const std::vector<Octave> octaves = octaves_of(model.features);
  std::vector<Octave> voters = octaves_of(scene_features);
  std::erase_if(voters, [&](const Octave& rows) {
    return std::none_of(octaves.begin(), octaves.end(),
                        [&](const Octave& octave) { return same_scale(octave, rows.resolution); });
  });
  return voters;
}

}  // namespace

poses::Sought sought_for(const LiveVotes& object, const poses::ScanState& scan,
                         const poses::SegmentParams& params) {
  const Model& model = object.votes->model->at(scan.resolution);
  return {model,
          scan,
          poses::instance_params(params, model, scan.resolution),
          params.terms,
          object.votes->votes_per_correspondence,
          voters_for(*object.votes->model, scan.features)};
}

std::vector<Hypothesis> modes_of(const LiveVotes& object) {
  const std::vector<std::uint32_t> best = density::best_votes(*object.votes, object.density());
  std::vector<Hypothesis> modes(best.size());
  graph::parallel_for(best.size(), 4096, [&](std::size_t i) {
    modes[i] = density::vote_hypothesis(*object.votes, best[i]);
    modes[i].support = object.density()[best[i]];
  });
  return modes;
}

poses::Proposals propose_from(LiveVotes& object, const poses::ScanState& scan,
                              const poses::Terms& terms) {
  return {[&object, &scan] {
            remove_explained(object, scan.feature_explained);
            return modes_of(object);
          },
          [&object, &terms](const Hypothesis& mode) {
            return density::refine_mode(*object.votes, *object.raw, object.alive, mode,
                                        terms.shift);
          }};
}

}  // namespace posevote::segment
