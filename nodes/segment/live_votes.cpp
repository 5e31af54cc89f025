// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/segment/live_votes.hpp"

#include <stdexcept>
#include <string>

#include "nodes/density/pose_index.hpp"

namespace posevote::segment {
namespace {

void check_object(const VoteSet& votes, const VoteDensity& density, std::size_t features) {
  const std::size_t count = votes.size();
  if (!votes.model) throw std::runtime_error("votes without a model");
  const auto fail = [&votes](const std::string& what) {
    throw std::runtime_error("votes of " + votes.model->name + ": " + what);
  };
  if (count == 0 && !votes.scene_feature.empty()) fail("no vote per correspondence");
  for (const auto* column :
       {&votes.tx, &votes.ty, &votes.tz, &votes.qw, &votes.qx, &votes.qy, &votes.qz})
    if (column->size() != count)
      fail(std::to_string(column->size()) + " poses, expected " + std::to_string(count));
  if (density.density.size() != count)
    fail(std::to_string(density.density.size()) + " densities, expected " + std::to_string(count));
  if (count > 0 && !density.index) fail("no pose index beside the densities");
  for (const auto* column : {&votes.scene_feature, &votes.single_feature})
    for (const std::uint32_t feature : *column)
      if (feature >= features)
        fail("scene feature " + std::to_string(feature) + " of " + std::to_string(features));
}

}  // namespace

LiveVotes all_votes(const VoteSet& votes, const VoteDensity& density) {
  return {&votes, &density, std::vector<char>(density.density.size(), 1), {}};
}

void remove_explained(LiveVotes& object, const std::vector<char>& explained) {
  const std::uint32_t per_correspondence = object.votes->votes_per_correspondence;
  std::vector<std::uint32_t> removed;
  for (std::size_t c = 0; c < object.votes->scene_feature.size(); ++c) {
    const auto first = static_cast<std::uint32_t>(c) * per_correspondence;
    if (!explained[object.votes->scene_feature[c]] || !object.alive[first]) continue;
    for (std::uint32_t vote = first; vote < first + per_correspondence; ++vote) {
      object.alive[vote] = 0;
      removed.push_back(vote);
    }
  }
  for (std::size_t i = 0; i < object.votes->single_feature.size(); ++i) {
    const auto vote = static_cast<std::uint32_t>(object.votes->circle_votes() + i);
    if (!explained[object.votes->single_feature[i]] || !object.alive[vote]) continue;
    object.alive[vote] = 0;
    removed.push_back(vote);
  }
  if (removed.empty()) return;
  if (object.left.empty()) object.left = object.raw->density;
  object.raw->index->subtract(removed, object.alive, object.left);
}

void check_votes(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                 std::size_t scene_features) {
  if (votes.size() != densities.size())
    throw std::runtime_error(std::to_string(votes.size()) + " vote sets but " +
                             std::to_string(densities.size()) + " sets of densities");
  for (std::size_t i = 0; i < votes.size(); ++i)
    check_object(votes[i], densities[i], scene_features);
}

}  // namespace posevote::segment
