// SPDX-License-Identifier: BSD-3-Clause
// For all queries of one translation cell together, or of a few sparse ones in a row, the others
// that are near enough in translation are collected once. Where they are few, queries look at all
// of them; where they are many, they are sorted by rotation cell, and queries look at the rows of
// cells within their reach. They look in groups, which are of like rotations because the votes of a
// cell are sorted by those.
//
// Where one set is weighed at its own votes, each pair is looked at once: a vote meets those behind it in its own
// cell and those of the cells behind, and what it weighs there is added there as well.
#include "nodes/density/density_sums.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/density/near_box.hpp"
#include "nodes/density/scan_votes.hpp"
#include "nodes/density/vote_section.hpp"
#include "nodes/density/vote_table.hpp"

namespace posevote::density {
namespace {

/// Queries of one translation cell, at most kMaxQueries of them, or of cells in a row along z.
struct Batch {
  CellRow cells;
  IndexRange queries;
};

constexpr std::uint32_t kMaxQueries = 4096;
constexpr std::uint32_t kMostOfRow = 32;  // queries of a batch of several cells: flat from 8 to 64
// Where sorting pays: measured on the votes of real scans, flat within half to twice.
constexpr std::uint32_t kFewestQueries = 16, kFewestSorted = 3000;
constexpr double kVotesPerCell = 16;
constexpr double kMostReach = 1.8;  // of a group, x one's: flat from 1.4 to 2

// At most so many ranges of batches, for the threads; what short ones add to is mostly others' sums.
constexpr std::size_t kMostRanges = 256;

std::vector<Batch> make_batches(const SortedVotes& queries) {
  std::vector<Batch> batches;
  for (std::uint32_t c = 0; c < queries.cells.size(); ++c) {
    const TranslationCell& cell = queries.cells[c];
    const std::uint32_t end = queries.cell_begin[c + 1];
    Batch* last = batches.empty() ? nullptr : &batches.back();
    if (last != nullptr && last->cells.is_before(cell) && end - last->queries.begin <= kMostOfRow) {
      ++last->cells.last_z;
      last->queries.end = end;
      continue;
    }
    for (std::uint32_t i = queries.cell_begin[c]; i < end; i += kMaxQueries)
      batches.push_back({{cell, cell.z}, {i, std::min(end, i + kMaxQueries)}});
  }
  return batches;
}

/// The work of one thread on batches that follow each other.
class BatchWorker {
 public:
  /// `queries` and `others` may be one and the same; then each pair of votes is looked at once.
  /// `first`: the first query of all batches.
  BatchWorker(const SortedVotes& queries, const SortedVotes& others, std::uint32_t first)
      : queries_(queries),
        others_(others),
        first_(first),
        search_(others),
        kernel_(make_kernel(queries.bandwidth)),
        loosest_(std::cos(kMostReach * std::acos(static_cast<double>(kernel_.min_cosine)))) {}

  void run(const Batch& batch);

  /// To be called at the end: the sums at the queries, and of one set what these weigh elsewhere.
  void add_to(std::vector<std::uint64_t>& sums) const {
    for (std::size_t i = 0; i < sums_.size(); ++i) sums[first_ + i] += sums_[i];
  }

 private:
  bool one_set() const { return &queries_ == &others_; }
  std::uint64_t& sum_of(std::uint32_t vote) { return sums_[vote - first_]; }
  void give_back();
  void collect(const Batch& batch);
  void sort_by_rotation(VoteSection& section, std::uint32_t query_count);
  std::uint32_t run_group(IndexRange queries);
  std::uint32_t find_blocks(const VotePoint* queries, std::uint32_t count, std::uint32_t from);

  const SortedVotes& queries_;
  const SortedVotes& others_;
  std::uint32_t first_;              ///< query
  std::vector<std::uint64_t> sums_;  ///< of it and those behind it
  CellSearch search_;
  Kernel kernel_;
  double loosest_;                      ///< cosine of a group's reach
  VoteTable near_;                      ///< the others that a batch meets
  std::vector<std::uint32_t> numbers_;  ///< of each
  std::vector<std::uint32_t> back_;     ///< what queries weigh at each, not yet added; else 0
  std::uint32_t back_count_ = 0;        ///< queries that have added to it
  VoteSection own_, ahead_;             ///< the batch's own votes, first; all others
  std::vector<IndexRange> blocks_;      ///< that a group looks at
  std::vector<std::uint32_t> found_;    ///< for scan_votes
  // of sort_by_rotation
  std::vector<RotationCode> codes_;
  std::vector<std::uint32_t> places_, moved_numbers_;
  std::vector<float> moved_;
};

void BatchWorker::run(const Batch& batch) {
  collect(batch);
  if (one_set() && own_.size() + ahead_.size() == 1) {  // it meets itself alone
    sum_of(batch.queries.begin) += kWeightUnits;
    return;
  }
  const std::uint32_t count = batch.queries.end - batch.queries.begin;
  sort_by_rotation(own_, count);
  sort_by_rotation(ahead_, count);
  // Within one set, the queries are the first votes of the table.
  const std::uint32_t first = one_set() ? 0 : batch.queries.begin;
  if (one_set())
    back_.resize(std::max(back_.size(), own_.size() + ahead_.size() + kScanPadding), 0);
  for (std::uint32_t i = 0; i < count;)
    i += run_group({first + i, first + std::min(count, i + kGroup)});
  if (one_set()) give_back();
}

/// Returns how many it has run: one alone if they are too far apart.
std::uint32_t BatchWorker::run_group(IndexRange queries) {
  const VoteTable& table = one_set() ? near_ : queries_.votes;
  VotePoint points[kGroup];
  std::uint64_t sums[kGroup];
  const std::uint32_t most = queries.end - queries.begin;
  for (std::uint32_t k = 0; k < most; ++k) points[k] = table.at(queries.begin + k);
  const std::uint32_t count = find_blocks(points, most, one_set() ? queries.begin : 0);
  const auto scan = [&](const Mutual* mutual) {
    scan_votes(kernel_, near_.columns(), points, count, {blocks_.data(), blocks_.size()}, mutual,
               found_.data(), sums);
  };
  if (!one_set()) {
    scan(nullptr);
    for (std::uint32_t k = 0; k < count; ++k) sum_of(queries.begin + k) = sums[k];
    return count;
  }
  const Mutual mutual{near_[0] + queries.begin, back_.data()};
  scan(&mutual);
  for (std::uint32_t k = 0; k < count; ++k)
    sum_of(numbers_[queries.begin + k]) += kWeightUnits + sums[k];  // 1 at itself
  if ((back_count_ += count) > kMostWeights - kGroup) give_back();
  return count;
}

/// Adds what the queries weigh at the others.
void BatchWorker::give_back() {
  const std::size_t count = own_.size() + ahead_.size();
  for (std::size_t i = 0; i < count; ++i) sum_of(numbers_[i]) += std::exchange(back_[i], 0);
  back_count_ = 0;
}

void BatchWorker::collect(const Batch& batch) {
  // Within one set, what lies before has met these queries already.
  const std::uint32_t first = one_set() ? batch.queries.begin : 0;
  const std::vector<IndexRange>& ranges = search_.around(batch.cells, one_set());
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
  near_.close(count);
  found_.resize(std::max(found_.size(), (count / kBlock + 1) * kFoundPerBlock + kGroup));
  own_ = VoteSection({0, own});
  ahead_ = VoteSection({own, count});
  const std::uint32_t end = one_set() ? ranges.back().end : batch.queries.end;
  sums_.resize(std::max<std::size_t>(sums_.size(), end - first_), 0);
}

void BatchWorker::sort_by_rotation(VoteSection& section, std::uint32_t query_count) {
  const std::uint32_t first = section.votes().begin, count = section.size();
  if (query_count < kFewestQueries || count < kFewestSorted) return;
  const double cells = std::cbrt(count / kVotesPerCell);
  codes_.resize(count);
  encode_rotations({near_[3] + first, near_[4] + first, near_[5] + first, near_[6] + first}, count,
                   codes_.data());
  section.sort(codes_,
               static_cast<std::uint32_t>(
                   std::clamp<double>(cells, 1, finest_rotation_cells(queries_.bandwidth))),
               places_);
  const auto move = [&](auto* items, auto& moved) {
    moved.resize(count);
    for (std::size_t i = 0; i < count; ++i) moved[places_[i] - first] = items[i];
    std::copy(moved.begin(), moved.end(), items);
  };
  for (std::size_t c = 0; c < kVoteColumns; ++c) move(near_[c] + first, moved_);
  move(&numbers_[first], moved_numbers_);
}

/// Finds all blocks with votes that the queries may meet, but for votes before `from`, and returns
/// of how many queries: of the first alone if all together reach much farther.
std::uint32_t BatchWorker::find_blocks(const VotePoint* queries, std::uint32_t count,
                                       std::uint32_t from) {
  blocks_.clear();
  RotationBoxes boxes;
  if (own_.is_sorted() || ahead_.is_sorted()) {
    RotationBall ball = reach_of(kernel_, queries, count);
    if (ball.cosine < loosest_) {
      count = 1;
      ball = reach_of(kernel_, queries, count);
    }
    boxes = rotation_boxes(ball);
  }
  for (const VoteSection* section : {&own_, &ahead_}) {
    if (section->is_sorted())
      for (std::size_t i = 0; i < boxes.count; ++i)
        section->add_rows(boxes.items[i], from, blocks_);
    else
      add_blocks({std::max(section->votes().begin, from), section->votes().end}, blocks_);
  }
  return count;
}

}  // namespace

std::vector<std::uint64_t> density_sums(const SortedVotes& queries, const SortedVotes& others) {
  std::vector<std::uint64_t> sums(queries.size(), 0);
  std::mutex adding;  // once a range; the order of integers does not matter
  const std::vector<Batch> batches = make_batches(queries);
  const std::size_t grain = batches.size() / kMostRanges;
  graph::parallel_ranges(batches.size(), grain, [&](std::size_t begin, std::size_t end) {
    BatchWorker worker(queries, others, batches[begin].queries.begin);
    for (std::size_t b = begin; b < end; ++b) worker.run(batches[b]);
    const std::scoped_lock lock(adding);
    worker.add_to(sums);
  });
  return sums;
}

std::vector<std::uint64_t> density_sums(const SortedVotes& votes) {
  return density_sums(votes, votes);
}

}  // namespace posevote::density
