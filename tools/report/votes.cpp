// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/votes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
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

ShownVotes choose(const VoteSet& votes, const std::vector<double>& density, std::size_t most) {
  ShownVotes shown;
  shown.count = votes.size();
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < votes.size(); ++v)
    if (density[v] > 0) order.push_back(v);
  std::stable_sort(order.begin(), order.end(), [&density](std::uint32_t a, std::uint32_t b) {
    return density[a] > density[b];
  });
  if (order.empty() || most == 0) return shown;
  shown.largest = density[order.front()];
  const std::size_t kept = std::min(most, order.size());
  shown.centers.resize(static_cast<Eigen::Index>(kept), 3);
  shown.heat.resize(kept);
  const double scale = std::log(std::max(shown.largest, 1 + 1e-9));
  for (std::size_t i = 0; i < kept; ++i) {
    const std::uint32_t vote = order[i * order.size() / kept];
    const std::size_t at = kept - 1 - i;
    shown.centers.row(static_cast<Eigen::Index>(at)) << votes.tx[vote], votes.ty[vote],
        votes.tz[vote];
    const double share = std::log(std::max(density[vote], 1.0)) / scale;
    shown.heat[at] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  }
  return shown;
}

}  // namespace

ShownVotes votes_of(const Configuration& configuration, const graph::Constants& constants,
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
    if (votes[i].model->obj_id == obj_id) return choose(votes[i], densities[i].density, most);
  throw std::invalid_argument("the run's library has no object " + std::to_string(obj_id));
}

}  // namespace posevote::page
