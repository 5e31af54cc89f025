// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/pose_index.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/density/density_sums.hpp"
#include "nodes/density/sorted_votes.hpp"

namespace posevote::density {

struct PoseIndex::Data {
  std::size_t vote_count;  ///< unusable ones included
  SortedVotes sorted;
  Kernel kernel;  ///< of its bandwidth
};

namespace {

constexpr float kRadian = 57.29578F;  // in degrees

void check_bandwidth(Bandwidth bandwidth) {
  const float degrees = bandwidth.sigma_r * kRadian;
  if (!(bandwidth.sigma_t >= 1e-9F && bandwidth.sigma_t <= 1e9F))
    throw std::invalid_argument("bandwidth sigma_t is " + std::to_string(bandwidth.sigma_t) +
                                " m, expected > 0");
  if (!(degrees >= 0.5F && degrees <= 90.001F))
    throw std::invalid_argument("bandwidth sigma_r is " + std::to_string(degrees) +
                                " deg, expected 0.5 to 90");
}

}  // namespace

PoseIndex::PoseIndex(const VoteSet& votes, Bandwidth bandwidth) {
  check_bandwidth(bandwidth);
  data_ = std::make_unique<const Data>(
      Data{votes.tx.size(), sort_votes(votes, bandwidth), make_kernel(bandwidth)});
}

PoseIndex::~PoseIndex() = default;

Bandwidth PoseIndex::bandwidth() const { return data_->sorted.bandwidth; }

std::vector<double> PoseIndex::densities() const {
  const SortedVotes& sorted = data_->sorted;
  const std::vector<std::uint64_t> sums = density_sums(sorted);
  std::vector<double> density(data_->vote_count, 0);
  graph::parallel_for(sums.size(), 16384,
                      [&](std::size_t i) { density[sorted.numbers[i]] = density_of(sums[i]); });
  return density;
}

void PoseIndex::subtract(const std::vector<std::uint32_t>& removed, const std::vector<char>& alive,
                         std::vector<double>& density) const {
  if (alive.size() != data_->vote_count || density.size() != data_->vote_count)
    throw std::invalid_argument("subtraction from " + std::to_string(density.size()) +
                                " densities, expected " + std::to_string(data_->vote_count));
  const SortedVotes& sorted = data_->sorted;
  for (const std::uint32_t v : removed) density.at(v) = 0;
  const auto left = static_cast<std::size_t>(
      std::ranges::count_if(alive, [](char is_alive) { return is_alive != 0; }));
  // The cost is that of queries times others: sum what is fewer, what went or what stayed.
  if (removed.size() > left) {
    const SortedVotes stayed = select_votes(sorted, positions_that(sorted, alive));
    const std::vector<std::uint64_t> sums = density_sums(stayed);
    for (std::size_t i = 0; i < sums.size(); ++i) density[stayed.numbers[i]] = density_of(sums[i]);
    return;
  }
  std::vector<char> is_gone(data_->vote_count, 0);
  for (const std::uint32_t v : removed) is_gone[v] = 1;
  const SortedVotes gone = select_votes(sorted, positions_that(sorted, is_gone));
  const SortedVotes near = select_votes(sorted, positions_near(sorted, gone, alive));
  const std::vector<std::uint64_t> sums = density_sums(near, gone);
  for (std::size_t i = 0; i < sums.size(); ++i) density[near.numbers[i]] -= density_of(sums[i]);
}

std::vector<WeightedVote> PoseIndex::neighbours(const Eigen::Vector3f& center,
                                                const Eigen::Quaternionf& rotation) const {
  const SortedVotes& sorted = data_->sorted;
  const VotePoint pose{center.x(),   center.y(),   center.z(),  rotation.w(),
                       rotation.x(), rotation.y(), rotation.z()};
  std::vector<WeightedVote> found;
  if (!is_usable(pose, sorted.bandwidth)) return found;
  CellSearch search(sorted);
  std::vector<std::uint32_t> places, weights;
  const TranslationCell cell = translation_cell(pose, sorted.bandwidth);
  for (const IndexRange& range : search.around({cell, cell.z})) {
    places.resize(std::max(places.size(), range.end - range.begin + kScanPadding));
    weights.resize(places.size());
    const std::size_t count = collect_near(data_->kernel, sorted.votes.columns(), pose, range,
                                           places.data(), weights.data());
    for (std::size_t i = 0; i < count; ++i)
      found.push_back({sorted.numbers[places[i]], static_cast<float>(weights[i]) / kWeightUnits});
  }
  return found;
}

}  // namespace posevote::density
