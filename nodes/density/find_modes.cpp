// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/find_modes.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "nodes/geometry/radix_sort.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::density {
namespace {

/// The highest first.
void sort_by_density(std::vector<std::uint32_t>& votes, const std::vector<double>& density) {
  struct Ranked {
    std::uint64_t key;
    std::uint32_t vote;
  };
  std::vector<Ranked> ranked;
  ranked.reserve(votes.size());
  // Bits of numbers that are not negative order as these do.
  for (const std::uint32_t vote : votes)
    ranked.push_back({~std::bit_cast<std::uint64_t>(density[vote]), vote});
  geometry::radix_sort(ranked, [](const Ranked& one) { return one.key; });
  for (std::size_t i = 0; i < votes.size(); ++i) votes[i] = ranked[i].vote;
}

}  // namespace

Eigen::Vector3f vote_center(const VoteSet& votes, std::uint32_t vote) {
  return {votes.tx[vote], votes.ty[vote], votes.tz[vote]};
}

Hypothesis vote_hypothesis(const VoteSet& votes, std::uint32_t vote) {
  return {vote_center(votes, vote),
          Eigen::Quaternionf(votes.qw[vote], votes.qx[vote], votes.qy[vote], votes.qz[vote]), 0};
}

std::vector<std::uint32_t> best_votes(const VoteSet& votes, const std::vector<double>& density) {
  const std::size_t per_correspondence = votes.votes_per_correspondence;
  if (per_correspondence == 0) return {};
  const std::size_t correspondences = votes.circle_votes() / per_correspondence;
  std::vector<std::uint32_t> best =
      geometry::joined_ranges(correspondences, [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> found;
        for (std::size_t c = first; c < last; ++c) {
          const auto begin = density.begin() + static_cast<std::ptrdiff_t>(c * per_correspondence);
          const auto highest =
              std::max_element(begin, begin + static_cast<std::ptrdiff_t>(per_correspondence));
          if (*highest > 0) found.push_back(static_cast<std::uint32_t>(highest - density.begin()));
        }
        return found;
      });
  for (std::size_t v = votes.circle_votes(); v < density.size(); ++v)
    if (density[v] > 0) best.push_back(static_cast<std::uint32_t>(v));
  sort_by_density(best, density);
  return best;
}

double runner_up_density(const VoteSet& votes, const std::vector<double>& density,
                         const Eigen::Vector3f& center, float radius) {
  double highest = 0;
  for (std::size_t v = 0; v < density.size(); ++v) {
    if (density[v] <= highest) continue;
    const auto vote = static_cast<std::uint32_t>(v);
    if ((vote_center(votes, vote) - center).norm() > radius) highest = density[v];
  }
  return highest;
}

}  // namespace posevote::density
