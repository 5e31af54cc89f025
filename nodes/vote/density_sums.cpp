// SPDX-License-Identifier: BSD-3-Clause
// For all queries of one translation cell together, the others that are near enough in translation
// are collected once. Where they are few, each query looks at all of them; where they are many,
// they are sorted by rotation cell, and each query looks at the rows of cells within its reach.
//
// Of one set at its own votes, each pair is looked at once: a vote meets those behind it in its own
// cell and those of the cells behind, and what it weighs there is added there as well.
#include "nodes/vote/density_sums.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/vote/scan_votes.hpp"
#include "nodes/vote/vote_section.hpp"
#include "nodes/vote/vote_table.hpp"

namespace posevote {
namespace {

/// Queries of one translation cell, at most kMaxQueries of them.
struct Batch {
  std::uint32_t cell;
  IndexRange queries;
};

constexpr std::uint32_t kMaxQueries = 4096;
// Where sorting pays: measured on the votes of real scans, flat within half to twice.
constexpr std::uint32_t kFewestQueries = 16, kFewestSorted = 1500;
constexpr double kVotesPerCell = 16;

// Of batches, for the threads; what short ones add to is mostly others' sums.
constexpr std::size_t kMostRanges = 256;

std::vector<Batch> make_batches(const SortedVotes& queries) {
  std::vector<Batch> batches;
  for (std::uint32_t c = 0; c < queries.cells.size(); ++c) {
    const std::uint32_t end = queries.cell_begin[c + 1];
    for (std::uint32_t i = queries.cell_begin[c]; i < end; i += kMaxQueries)
      batches.push_back({c, {i, std::min(end, i + kMaxQueries)}});
  }
  return batches;
}

VoteBox bounding_box(const VoteColumns& votes, IndexRange range) {
  VoteBox box{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax_element(votes[a] + range.begin, votes[a] + range.end);
    box.low[a] = *low;
    box.high[a] = *high;
  }
  return box;
}

/// The work of one thread on batches that follow each other.
class BatchWorker {
 public:
  /// `queries` and `others` may be one and the same; then each pair of votes is looked at once.
  /// `first`: the first query of all batches.
  BatchWorker(const SortedVotes& queries, const SortedVotes& others, std::uint32_t first,
              std::vector<std::uint64_t>& sums)
      : queries_(queries),
        others_(others),
        first_(first),
        sums_(sums),
        search_(others),
        kernel_(make_kernel(queries.bandwidth)),
        reach_(make_rotation_reach(kernel_, queries.bandwidth)) {}

  void run(const Batch& batch);

  /// To be called at the end. Other threads may add to the same sums; the order of integers does
  /// not matter.
  void add_to_sums() {
    for (std::size_t i = 0; i < my_sums_.size(); ++i)
      if (my_sums_[i] != 0)
        std::atomic_ref(sums_[first_ + i]).fetch_add(my_sums_[i], std::memory_order_relaxed);
  }

 private:
  bool one_set() const { return &queries_ == &others_; }
  void give_back();
  void collect(const Batch& batch);
  void sort_by_rotation(VoteSection& section, std::uint32_t query_count);
  std::uint64_t sum_at(const VotePoint& query, std::uint32_t from);

  const SortedVotes& queries_;
  const SortedVotes& others_;
  std::uint32_t first_;                 ///< query
  std::vector<std::uint64_t> my_sums_;  ///< of it and those behind it, not yet in sums_
  std::vector<std::uint64_t>& sums_;
  CellSearch search_;
  Kernel kernel_;
  RotationReach reach_;
  VoteTable near_;                      ///< the others that a batch meets
  std::vector<std::uint32_t> numbers_;  ///< of each
  std::vector<std::uint32_t> back_;     ///< what the queries weigh at each, not yet added
  VoteSection own_, ahead_;             ///< the batch's own votes, first; all others
  std::vector<IndexRange> rows_;
  // of sort_by_rotation
  std::vector<RotationCode> codes_;
  std::vector<std::uint32_t> places_;
  std::vector<float> moved_;
};

void BatchWorker::run(const Batch& batch) {
  collect(batch);
  const std::uint32_t count = batch.queries.end - batch.queries.begin;
  sort_by_rotation(own_, count);
  sort_by_rotation(ahead_, count);
  if (!one_set()) {
    for (std::uint32_t i = batch.queries.begin; i < batch.queries.end; ++i)
      my_sums_[i - first_] = sum_at(queries_.votes.at(i), 0);
    return;
  }
  back_.assign(own_.size() + ahead_.size() + kScanPadding, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    // A vote weighs 1 at itself.
    my_sums_[numbers_[i] - first_] += kWeightUnits + sum_at(near_.at(i), i + 1);
    if (i % kMostWeights == kMostWeights - 1) {
      give_back();
      std::fill(back_.begin(), back_.end(), 0);
    }
  }
  give_back();
}

/// Adds what the queries weigh at the others.
void BatchWorker::give_back() {
  const std::size_t count = own_.size() + ahead_.size();
  for (std::size_t i = 0; i < count; ++i) my_sums_[numbers_[i] - first_] += back_[i];
}

void BatchWorker::collect(const Batch& batch) {
  // Of one set, what lies before has met these queries already.
  const std::uint32_t first = one_set() ? batch.queries.begin : 0;
  const std::vector<IndexRange>& ranges = search_.around(queries_.cells[batch.cell], one_set());
  std::size_t most = 0;
  for (const IndexRange& range : ranges) most += range.end - range.begin;
  near_.resize(most);
  if (numbers_.size() < most + kScanPadding) numbers_.resize(most + kScanPadding);
  const VoteBox box = bounding_box(queries_.votes.columns(), batch.queries);
  std::uint32_t count = 0;
  for (const IndexRange& range : ranges)
    if (range.end > first)
      count += static_cast<std::uint32_t>(
          copy_near(kernel_, others_.votes.columns(), {std::max(range.begin, first), range.end},
                    box, near_[0] + count, near_.stride(), numbers_.data() + count));
  // The queries lie in their own box, so that all of them are there, and first.
  const std::uint32_t own = one_set() ? batch.queries.end - batch.queries.begin : 0;
  own_ = VoteSection({0, own});
  ahead_ = VoteSection({own, count});
  const std::uint32_t end = one_set() ? ranges.back().end : batch.queries.end;
  my_sums_.resize(std::max<std::size_t>(my_sums_.size(), end - first_), 0);
}

void BatchWorker::sort_by_rotation(VoteSection& section, std::uint32_t query_count) {
  const std::uint32_t first = section.votes().begin, count = section.size();
  if (query_count < kFewestQueries || count < kFewestSorted) return;
  const double cells = std::cbrt(count / kVotesPerCell);
  codes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) codes_[i] = others_.codes[numbers_[first + i]];
  section.sort(codes_,
               static_cast<std::uint32_t>(std::clamp<double>(cells, 1, reach_.cells_per_axis)),
               places_);
  moved_.resize(count);
  for (std::size_t c = 0; c < kVoteColumns; ++c) {
    float* column = near_[c] + first;
    for (std::size_t i = 0; i < count; ++i) moved_[places_[i] - first] = column[i];
    std::copy(moved_.begin(), moved_.end(), column);
  }
  std::uint32_t* numbers = &numbers_[first];
  std::copy_n(numbers, count, codes_.begin());
  for (std::size_t i = 0; i < count; ++i) numbers[places_[i] - first] = codes_[i];
}

/// Of the votes from `from` on.
std::uint64_t BatchWorker::sum_at(const VotePoint& query, std::uint32_t from) {
  rows_.clear();
  RotationBoxes boxes;
  if (own_.is_sorted() || ahead_.is_sorted()) boxes = rotation_boxes(query, reach_);
  for (const VoteSection* section : {&own_, &ahead_}) {
    if (section->is_sorted())
      for (std::size_t i = 0; i < boxes.count; ++i) section->add_rows(boxes.items[i], from, rows_);
    else
      rows_.push_back({std::max(section->votes().begin, from), section->votes().end});
  }
  return scan_votes(kernel_, near_.columns(), query, rows_.data(), rows_.size(),
                    one_set() ? back_.data() : nullptr);
}

}  // namespace

std::vector<std::uint64_t> density_sums(const SortedVotes& queries, const SortedVotes& others) {
  std::vector<std::uint64_t> sums(queries.size(), 0);
  const std::vector<Batch> batches = make_batches(queries);
  const std::size_t grain = batches.size() / kMostRanges;
  graph::parallel_ranges(batches.size(), grain, [&](std::size_t begin, std::size_t end) {
    BatchWorker worker(queries, others, batches[begin].queries.begin, sums);
    for (std::size_t b = begin; b < end; ++b) worker.run(batches[b]);
    worker.add_to_sums();
  });
  return sums;
}

std::vector<std::uint64_t> density_sums(const SortedVotes& votes) {
  return density_sums(votes, votes);
}

}  // namespace posevote
