// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pair_votes.hpp"

#include <algorithm>
#include <numbers>
#include <span>

#include "nodes/pairs/pair_key.hpp"

namespace posevote::pairs {

void PairVotes::count_pairs(const PairTable& table, const LocalFrame& at, const PairScene& scene) {
  counts_.assign(table.points().size() * kTurns, 0);
  for (const std::uint32_t bin : touched_) seen_[bin] = 0;
  touched_.clear();
  seen_.resize(std::max(seen_.size(), table.bins()));
  scene.for_each_within(at.point, table.reach(), [&](const PairScene::Point& other) {
    const Eigen::Vector3f offset = other.point - at.point;
    const std::uint32_t bin = pair_bin(at.normal, other.normal, offset, table.step());
    if (bin >= table.bins()) return;
    const std::uint8_t turn = at.turn_to(offset);
    // Many points of a plane make the same pair: it counts once for each turn (Vidal et al. 2018).
    const std::uint32_t flag = 1U << (turn / (256 / kTurns));
    if (seen_[bin] & flag) return;
    if (seen_[bin] == 0) touched_.push_back(bin);
    seen_[bin] |= flag;
    for (const PairEnd end : table[bin])
      ++counts_[end.point * kTurns + static_cast<std::uint8_t>(turn - end.turn) / (256 / kTurns)];
  });
}

/// The best turn of one point: its count and its neighbours', whose balance tells where between them
/// it lies.
PairPeak PairVotes::peak_of(std::uint16_t point) const {
  const std::uint16_t* counts = &counts_[point * kTurns];
  PairPeak best;
  for (std::uint32_t k = 0; k < kTurns; ++k) {
    const std::uint32_t before = counts[(k + kTurns - 1) % kTurns], here = counts[k],
                        after = counts[(k + 1) % kTurns], sum = before + here + after;
    if (sum <= best.pairs || here < before || here < after) continue;
    const float lean =
        (static_cast<float>(after) - static_cast<float>(before)) / static_cast<float>(sum);
    best = {
        point,
        (static_cast<float>(k) + 0.5F + lean) * static_cast<float>(2 * std::numbers::pi / kTurns),
        sum};
  }
  return best;
}

std::vector<PairPeak> PairVotes::peaks(const PairTable& table, const LocalFrame& at,
                                       const PairScene& scene, std::size_t count, double ratio) {
  count_pairs(table, at, scene);
  std::vector<PairPeak> peaks;
  std::uint32_t best = 0;
  for (std::size_t point = 0; point < table.points().size(); ++point) {
    const auto counts = std::span(counts_).subspan(point * kTurns, kTurns);
    const std::uint32_t most = *std::max_element(counts.begin(), counts.end());
    if (most == 0 || 3 * most < ratio * best) continue;  // three turns make a peak
    peaks.push_back(peak_of(static_cast<std::uint16_t>(point)));
    best = std::max(best, peaks.back().pairs);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const PairPeak& a, const PairPeak& b) { return a.pairs > b.pairs; });
  if (peaks.size() > count) peaks.resize(count);
  while (!peaks.empty() && peaks.back().pairs < ratio * peaks.front().pairs) peaks.pop_back();
  return peaks;
}

}  // namespace posevote::pairs
