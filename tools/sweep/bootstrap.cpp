// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/bootstrap.hpp"

#include <algorithm>

#include "graph/parallel.hpp"
#include "nodes/data/splitmix64.hpp"

namespace posevote::sweep {
namespace {

constexpr std::size_t kDraws = 2000;

void add(Counts& sum, const Counts& counts) {
  sum.correct += counts.correct;
  sum.instances += counts.instances;
  sum.detections += counts.detections;
}

/// Which images each draw takes, one draw behind the other.
std::vector<std::size_t> draw_images(std::size_t images, std::uint64_t seed) {
  std::vector<std::size_t> drawn(kDraws * images);
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drawn[i] = splitmix64(splitmix64(seed) + i) % images;
  return drawn;
}

/// The sums of a setting, by draw.
std::vector<Counts> redraw(const std::vector<Counts>& images,
                           const std::vector<std::size_t>& drawn) {
  std::vector<Counts> sums(kDraws);
  for (std::size_t i = 0; i < drawn.size(); ++i) add(sums[i / images.size()], images[drawn[i]]);
  return sums;
}

Interval interval_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t tail = kDraws / 40;
  return {values[tail], values[kDraws - 1 - tail]};
}

}  // namespace

Counts total_of(const std::vector<Counts>& images) {
  Counts sum;
  for (const Counts& counts : images) add(sum, counts);
  return sum;
}

std::vector<Certainty> bootstrap(const std::vector<std::vector<Counts>>& images, std::size_t best,
                                 Figure figure, std::uint64_t seed) {
  std::vector<Certainty> certainties(images.size());
  if (images.empty() || images[best].size() < 2) return certainties;
  const std::vector<std::size_t> drawn = draw_images(images[best].size(), seed);
  const std::vector<Counts> best_sums = redraw(images[best], drawn);
  graph::parallel_for(images.size(), 1, [&](std::size_t setting) {
    const std::vector<Counts> sums = redraw(images[setting], drawn);
    std::vector<double> recall, f1, behind;
    for (std::size_t i = 0; i < kDraws; ++i) {
      recall.push_back(sums[i].recall());
      f1.push_back(sums[i].f1());
      behind.push_back((best_sums[i].*figure)() - (sums[i].*figure)());
    }
    certainties[setting] = {interval_of(recall), interval_of(f1), interval_of(behind)};
  });
  return certainties;
}

}  // namespace posevote::sweep
