// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/votes.hpp"

#include <stdexcept>

#include "tools/ablation/replay.hpp"

namespace posevote::page {
namespace {

using Votes = graph::StreamTraits<PerObject<VoteSet>>;
using Densities = graph::StreamTraits<PerObject<VoteDensity>>;

/// The node that turns votes into densities, whatever it is called.
const graph::PlannedNode& density_node(const graph::Plan& plan) {
  for (const graph::PlannedNode& node : plan.nodes)
    if (!node.outputs.empty() && node.outputs[0] >= 0 && !node.inputs.empty() &&
        plan.streams[std::size_t(node.outputs[0])].type == Densities::type() &&
        plan.streams[std::size_t(node.inputs[0])].type == Votes::type())
      return node;
  throw std::invalid_argument("the pipeline " + plan.name + " estimates no density of votes");
}

}  // namespace

pictures::DenseVotes votes_of(const Configuration& configuration, const graph::Constants& constants,
                              const SceneFile& scene, int obj_id, std::size_t most) {
  const graph::Plan& plan = configuration.scenes;
  const graph::PlannedNode& node = density_node(plan);
  const ablation::Replay scan(plan, constants, {std::make_shared<const SceneFile>(scene)}, {},
                              node.outputs[0]);
  const auto stream = [&](int number) {
    return scan.value(plan.streams[std::size_t(number)].name);
  };
  const auto votes = Votes::unwrap(stream(node.inputs[0]));
  const auto densities = Densities::unwrap(stream(node.outputs[0]));
  for (std::size_t i = 0; i < votes.size(); ++i)
    if (votes[i].model->obj_id == obj_id)
      return pictures::dense_votes(votes[i], densities[i].density, most);
  throw std::invalid_argument("the run's library has no object " + std::to_string(obj_id));
}

}  // namespace posevote::page
