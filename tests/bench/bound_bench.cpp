// SPDX-License-Identifier: BSD-3-Clause
// How near the innermost loops come to what the machine can do: each on data in the cache, beside
// the machine's own rates. `ops` are the multiplies, adds, comparisons and conversions that an item
// takes, counted in the source, roots and quotients as one; `of_machine` is the share of the rate
// that machine_arithmetic measures. One thread.
//
//   build/tests/bench_kernels --benchmark_filter='machine|inner'
#include <benchmark/benchmark.h>
#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <ctime>
#include <random>
#include <vector>

#include "nodes/density/scan_votes.hpp"
#include "nodes/density/vote_table.hpp"
#include "nodes/describe/point_pair_sums.hpp"
#include "nodes/descriptors/descriptor_kernels.hpp"
#include "nodes/geometry/plane_moments.hpp"
#include "tests/bench/machine_rate.hpp"

namespace posevote {
namespace {

constexpr std::size_t kItems = 1024;
constexpr std::size_t kPadded = kItems + density::kScanPadding;
constexpr std::size_t kRounds = 10000;

/// Numbers in [-1, 1].
std::vector<float> numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<float> values(count);
  for (float& value : values) value = uniform(random);
  return values;
}

/// Operations a second, measured once.
double machine_rate() {
  static const double rate = [] {
    float sink[16];
    const std::clock_t start = std::clock();  // of the processor: others may run beside
    double done = 0, passed = 0;
    while (passed < 0.2) {
      done += do_arithmetic(kRounds, sink);
      passed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    return done / passed;
  }();
  return rate;
}

void report(benchmark::State& state, double items, double ops) {
  const double all = static_cast<double>(state.iterations()) * items;
  state.SetItemsProcessed(static_cast<std::int64_t>(all));
  state.counters["ops"] = ops;
  state.counters["of_machine"] =
      benchmark::Counter(all * ops / machine_rate(), benchmark::Counter::kIsRate);
}

void machine_arithmetic(benchmark::State& state) {
  float sink[16];
  double done = 0;
  for (auto _ : state) done += do_arithmetic(kRounds, sink);
  benchmark::DoNotOptimize(sink);
  state.SetItemsProcessed(static_cast<std::int64_t>(done));
}

void machine_read(benchmark::State& state) {
  const std::vector<float> values(static_cast<std::size_t>(state.range(0)) / sizeof(float), 1);
  for (auto _ : state) benchmark::DoNotOptimize(read_all(values.data(), values.size()));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * state.range(0));
}

void inner_plane_moments(benchmark::State& state) {
  const auto x = numbers(kPadded, 1), y = numbers(kPadded, 2), z = numbers(kPadded, 3);
  const geometry::GridRun run{0, kItems};
  const float center[3] = {0, 0, 0};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        geometry::plane_moments({x.data(), y.data(), z.data(), x.data()}, &run, 1, center, 1));
  report(state, kItems, 37);
}

void inner_point_pairs(benchmark::State& state) {
  std::vector<std::vector<float>> c;
  for (unsigned i = 0; i < 6; ++i) c.push_back(numbers(kPadded, i));
  const geometry::GridRun run{0, kItems};
  const float point[3] = {0, 0, 0}, normal[3] = {0, 0, 1};
  describe::PointPairSums sums{};
  for (auto _ : state)  // all are near, all face the same side
    benchmark::DoNotOptimize(describe::add_point_pairs(
        {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(), c[5].data()}, &run, 1,
        {point, normal, 2, -2}, sums));
  report(state, kItems, 185);
}

void inner_votes(benchmark::State& state) {
  density::VoteTable votes;
  votes.resize(kItems);
  for (unsigned c = 0; c < density::kVoteColumns; ++c) {  // all are near
    const std::vector<float> column = numbers(kItems, c);
    std::transform(column.begin(), column.end(), votes[c],
                   [c](float x) { return c == 3 ? 1 : 1e-3F * x; });
  }
  const density::IndexRange range{0, kItems / density::kBlock};
  std::vector<std::uint32_t> back(kPadded, 0),
      found(kItems / density::kBlock * density::kFoundPerBlock + density::kGroup);
  const density::Kernel kernel = density::make_kernel({});
  density::VotePoint queries[density::kGroup];
  std::fill_n(queries, density::kGroup, density::VotePoint{0, 0, 0, 1, 0, 0, 0});
  float nowhere[density::kGroup];
  const density::Mutual mutual{nowhere, back.data()};
  std::uint64_t sums[density::kGroup];
  for (auto _ : state) {
    density::scan_votes(kernel, votes.columns(), queries, density::kGroup, {&range, 1}, &mutual,
                        found.data(), sums);
    benchmark::DoNotOptimize(sums);
  }
  report(state, density::kGroup * kItems, 53);
}

void inner_scores(benchmark::State& state) {
  constexpr std::size_t kDimension = 64, kPairs = kDimension / 2;
  const std::vector<descriptors::Pair> queries(descriptors::kTileQueries * kPairs, {100, -200});
  const std::vector<float> factors(descriptors::kTileQueries, 0.5F);
  const hwy::AlignedFreeUniquePtr<descriptors::Pair[]> panel =
      hwy::AllocateAligned<descriptors::Pair>(descriptors::kPanelRows * kPairs);
  std::fill_n(panel.get(), descriptors::kPanelRows * kPairs, descriptors::Pair{300, 400});
  const std::vector<float> half_norms(descriptors::kPanelRows, 1);
  std::vector<float> scores(descriptors::kTileQueries * descriptors::kPanelRows);
  for (auto _ : state) {
    descriptors::score_panel(queries.data(), factors.data(), panel.get(), kPairs, half_norms.data(),
                             scores.data(), descriptors::kPanelRows);
    benchmark::DoNotOptimize(scores.data());
  }
  // A multiply-add counts as one; whole numbers may do better than the machine's rate in floats.
  report(state, static_cast<double>(descriptors::kTileQueries * descriptors::kPanelRows),
         kDimension);
}

BENCHMARK(machine_arithmetic);
BENCHMARK(machine_read)->Arg(16 << 10)->Arg(512 << 10)->Arg(256 << 20);
BENCHMARK(inner_plane_moments);
BENCHMARK(inner_point_pairs);
BENCHMARK(inner_votes);
BENCHMARK(inner_scores);

}  // namespace
}  // namespace posevote
