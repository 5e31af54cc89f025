// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pair_votes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "nodes/color/srgb.hpp"
#include "nodes/pairs/color_step.hpp"
#include "nodes/pairs/pair_key.hpp"

namespace posevote::pairs {
namespace {

/// Turns that differ by less are one where a frame leaves none open: 20 deg, in 256ths.
constexpr int kSameTurn = 14;
constexpr std::size_t kAhead = 8;          // pairs, between a fetch and what it is for
constexpr std::uint16_t kFewestPairs = 3;  // of a pose without a turn to tell

}  // namespace

PairScene::PairScene(const Cloud& thin, float cell, int)
    : grid_(thin.points, cell),
      normals_(geometry::in_order_of(grid_, thin.normals, [](std::uint32_t) { return true; })) {
  if (thin.colors.rows() > 0) lab_ = color::lab_of(thin.colors)(grid_.indices(), Eigen::all);
}

PairStart start_at(const LocalFrame& at, float reach, bool keeps_all) {
  PairStart start{};
  const auto set = [](float(&to)[3], const Eigen::Vector3f& from) {
    Eigen::Vector3f::Map(to) = from;
  };
  set(start.point, at.point), set(start.normal, at.normal), set(start.u, at.u), set(start.v, at.v);
  start.reach = reach;
  start.keeps_all = keeps_all;
  return start;
}

void PairVotes::go_to(const LocalFrame& at, const PairScene& scene, float reach) {
  scene.find_runs(at.point, reach, runs_);
  std::size_t room = geometry::kGridPadding;
  for (const geometry::GridRun& run : runs_) room += run.end - run.begin;
  lengths_.resize(std::max(lengths_.size(), room));
  numbers_.resize(std::max(numbers_.size(), 5 * room));
  std::int32_t* numbers = numbers_.data();
  const PairColumns found{lengths_.data(),    numbers,           numbers + room, numbers + 2 * room,
                          numbers + 3 * room, numbers + 4 * room};
  const std::size_t count = find_pairs(scene.columns(), runs_.data(), runs_.size(),
                                       start_at(at, reach, scene.has_colors()), found);

  // The own colour is that of the nearest point.
  color_from_ = std::numeric_limits<float>::infinity();
  Eigen::Vector3f own_color = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; scene.has_colors() && k < count; ++k)
    if (found.length[k] <= color_from_) {
      color_from_ = found.length[k];
      own_color = scene.lab().row(found.position[k]).transpose();
    }
  others_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    if (found.from[k] < 0) continue;
    others_.push_back({found.length[k], angle_bins(found.from[k], found.to[k], found.between[k]),
                       static_cast<std::uint8_t>(found.turn[k]), 0});
    if (scene.has_colors())
      others_.back().color = color_step(own_color, scene.lab().row(found.position[k]).transpose());
  }
}

// Bins are all over the memory, so they are fetched before they are needed: their starts first, then
// the pairs that lie there.
template <class Visit>
void PairVotes::for_each_pair(const PairTable& table, const Visit& visit) {
  for (const std::uint32_t bin : touched_) seen_[bin] = 0;
  touched_.clear();
  seen_.resize(std::max(seen_.size(), table.bins()));
  pairs_.clear();
  for (const Other& other : others_) {
    if (other.length > table.reach()) continue;
    const std::uint32_t bin = pair_bin(other.length, other.angles, table.step());
    if (bin < table.bins()) pairs_.push_back({bin, other.turn, other.color});
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (i + 2 * kAhead < pairs_.size()) {
      const std::uint32_t bin = pairs_[i + 2 * kAhead].bin;
      __builtin_prefetch(&seen_[bin], 1);
      table.fetch_start(bin);
    }
    if (i + kAhead < pairs_.size()) table.fetch_pairs(pairs_[i + kAhead].bin);
    const auto [bin, turn, color] = pairs_[i];
    // Many points of a plane make the same pair: it counts once for each turn (Vidal et al. 2018).
    const std::uint32_t flag = 1U << (turn / (256 / kTurns));
    if (seen_[bin] & flag) continue;
    if (seen_[bin] == 0) touched_.push_back(bin);
    seen_[bin] |= flag;
    visit(bin, turn, color);
  }
}

/// The best turn of one point: its count and its neighbours', whose balance tells where between them
/// it lies. Without branches but at the end, so that compilers take many turns at once.
PairPeak PairVotes::peak_of(std::size_t point) const {
  const std::uint16_t* counts = &counts_[point * kTurns];
  std::array<std::int32_t, kTurns + 2> ring;  // whose ends meet
  std::copy_n(counts, kTurns, ring.begin() + 1);
  ring.front() = counts[kTurns - 1];
  ring.back() = counts[0];
  std::array<std::int32_t, kTurns> sums;
  std::int32_t most = 0;
  for (std::size_t k = 0; k < kTurns; ++k) {
    const bool is_peak = (ring[k + 1] >= ring[k]) & (ring[k + 1] >= ring[k + 2]);
    sums[k] = is_peak ? ring[k] + ring[k + 1] + ring[k + 2] : 0;
    most = std::max(most, sums[k]);
  }
  if (most == 0) return {};
  const auto at = static_cast<std::size_t>(std::ranges::find(sums, most) - sums.begin());
  const float lean =
      (static_cast<float>(ring[at + 2]) - static_cast<float>(ring[at])) / static_cast<float>(most);
  return {
      static_cast<std::uint16_t>(point),
      (static_cast<float>(at) + 0.5F + lean) * static_cast<float>(2 * std::numbers::pi / kTurns),
      static_cast<std::uint32_t>(most)};
}

/// Of every point that may be among the best.
std::vector<PairPeak> PairVotes::peaks_of_turns(std::size_t points, double ratio) {
  std::vector<PairPeak> peaks;
  if (points == 0) return peaks;
  most_.resize(points);
  for (std::size_t point = 0; point < points; ++point) {
    const std::uint16_t* counts = &counts_[point * kTurns];
    std::uint16_t most = 0;
    for (std::uint32_t k = 0; k < kTurns; ++k) most = std::max(most, counts[k]);
    most_[point] = most;
  }
  // The best first, so that few of the others need a look.
  const auto first = std::max_element(most_.begin(), most_.end()) - most_.begin();
  const std::uint32_t best = peak_of(static_cast<std::size_t>(first)).pairs;
  for (std::size_t point = 0; point < points; ++point)
    if (most_[point] != 0 && 3 * most_[point] >= ratio * best)  // three turns make a peak
      peaks.push_back(peak_of(point));
  return peaks;
}

std::vector<PairPeak> PairVotes::peaks_of_points(double ratio) const {
  std::vector<PairPeak> peaks;
  if (counts_.empty()) return peaks;
  const double least =
      std::max<double>(kFewestPairs, ratio * *std::max_element(counts_.begin(), counts_.end()));
  for (std::size_t point = 0; point < counts_.size(); ++point)
    if (counts_[point] >= least)
      peaks.push_back({static_cast<std::uint16_t>(point), 0, counts_[point]});
  return peaks;
}

void PairVotes::count_by_color(const PairTable& table, std::uint16_t like_color) {
  const auto extra = static_cast<std::uint16_t>(like_color - 1);
  for_each_pair(table, [&](std::uint32_t bin, std::uint8_t turn, std::uint8_t color) {
    const LikeSteps& like = like_steps(color);
    for (const PairEnd end : table[bin]) {
      const auto off = static_cast<std::uint8_t>(turn - end.turn);
      std::uint16_t& count = counts_[end.point * kTurns + off / (256 / kTurns)];
      count = static_cast<std::uint16_t>(count + 1 + extra * like[end.color]);
    }
  });
}

void PairVotes::count(const PairTable& table, const PeakOptions& options) {
  const bool is_open = options.turn == Turn::kOpen;
  counts_.assign(table.points().size() * (is_open ? kTurns : 1), 0);
  if (is_open && table.has_colors() && color_from_ <= 2 * table.step())
    return count_by_color(table, options.like_color);
  turned_.clear();
  for_each_pair(table, [&](std::uint32_t bin, std::uint8_t turn, std::uint8_t) {
    if (is_open)
      table.add_all(bin, turn, turned_);
    else
      table.add_turned(bin, turn, kSameTurn, turned_);
  });
  if (is_open)
    count_turns(table.ends(), turned_.data(), turned_.size(), counts_.data());
  else
    count_turned(table.ends(), turned_.data(), turned_.size(), 2 * kSameTurn, counts_.data());
}

std::vector<PairPeak> PairVotes::peaks(const PairTable& table, const PeakOptions& options) {
  count(table, options);
  std::vector<PairPeak> peaks = options.turn == Turn::kOpen
                                    ? peaks_of_turns(table.points().size(), options.least_ratio)
                                    : peaks_of_points(options.least_ratio);
  // The best alone are sorted; each point has one peak at most.
  const std::size_t kept = std::min(peaks.size(), options.poses);
  std::partial_sort(peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(kept), peaks.end(),
                    [](const PairPeak& a, const PairPeak& b) {
                      return a.pairs != b.pairs ? a.pairs > b.pairs : a.point < b.point;
                    });
  peaks.resize(kept);
  while (!peaks.empty() && peaks.back().pairs < options.least_ratio * peaks.front().pairs)
    peaks.pop_back();
  return peaks;
}

}  // namespace posevote::pairs
