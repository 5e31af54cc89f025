// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pictures/dense_votes.hpp"

#include <algorithm>
#include <cmath>

namespace posevote::pictures {

DenseVotes dense_votes(const VoteSet& votes, const std::vector<double>& density, std::size_t most) {
  DenseVotes shown;
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

}  // namespace posevote::pictures
