// SPDX-License-Identifier: BSD-3-Clause
// For all queries of one translation cell together, the others that are near enough in translation
// are collected once and sorted by rotation cell; then each query reads only the rows of rotation
// cells within its reach. Collecting costs a few ns for each of the ~20 others per query that it
// finds, and makes the scans contiguous: that is what the wide instructions need.
//
// Of one set at its own votes, a cell meets only itself and the cells behind it, and what it
// weighs at those is added there as well: half the work.
#include "nodes/vote/density_sums.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/vote/scan_votes.hpp"

namespace posevote {
namespace {

/// Queries of one translation cell, at most kMaxQueries of them.
struct Batch {
  std::uint32_t cell, begin, end;
};

constexpr std::uint32_t kMaxQueries = 4096;

std::vector<Batch> make_batches(const SortedVotes& queries) {
  std::vector<Batch> batches;
  for (std::uint32_t c = 0; c < queries.cells.size(); ++c)
    for (std::uint32_t i = queries.cell_begin[c]; i < queries.cell_begin[c + 1]; i += kMaxQueries)
      batches.push_back({c, i, std::min(queries.cell_begin[c + 1], i + kMaxQueries)});
  return batches;
}

/// Bounding box of translations.
struct Box {
  std::array<float, 3> low, high;

  /// Never above that from any point inside: rounding is monotone, and the order of operations that
  /// of the kernel's squared_distance.
  float squared_distance(const VotePoint& p) const {
    const float dx = std::max({low[0] - p.tx, p.tx - high[0], 0.0F});
    const float dy = std::max({low[1] - p.ty, p.ty - high[1], 0.0F});
    const float dz = std::max({low[2] - p.tz, p.tz - high[2], 0.0F});
    return (dx * dx + dy * dy) + dz * dz;
  }
};

Box bounding_box(const SortedVotes& votes, std::uint32_t begin, std::uint32_t end) {
  const VotePoint& first = votes.votes[begin].point;
  Box box{{first.tx, first.ty, first.tz}, {first.tx, first.ty, first.tz}};
  for (std::uint32_t i = begin; i < end; ++i) {
    const VotePoint& p = votes.votes[i].point;
    const std::array<float, 3> t{p.tx, p.ty, p.tz};
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], t[a]);
      box.high[a] = std::max(box.high[a], t[a]);
    }
  }
  return box;
}

/// The work of one thread; its buffers live as long as its range of batches.
class BatchWorker {
 public:
  /// `queries` and `others` may be one and the same; then votes of different cells are looked at
  /// once a pair.
  BatchWorker(const SortedVotes& queries, const SortedVotes& others,
              std::vector<std::uint64_t>& sums)
      : queries_(queries),
        others_(others),
        sums_(sums),
        search_(others),
        kernel_(make_kernel(queries.bandwidth)),
        reach_(make_rotation_reach(kernel_, queries.bandwidth)) {}

  void run(const Batch& batch) {
    collect(batch);
    if (near_.empty()) return;
    choose_grid(batch.end - batch.begin);
    sort_by_rotation();
    back_.assign(one_set() ? order_.size() + kScanPadding : 0, 0);
    for (std::uint32_t i = batch.begin; i < batch.end; ++i) {
      add(i, sum_at(queries_.votes[i]));
      if ((i - batch.begin) % kMostWeights == kMostWeights - 1) give_back(batch);
    }
    give_back(batch);
  }

 private:
  bool one_set() const { return &queries_ == &others_; }
  /// Other batches may add to the same sum; the order of integers does not matter.
  void add(std::uint32_t i, std::uint64_t units) {
    std::atomic_ref(sums_[i]).fetch_add(units, std::memory_order_relaxed);
  }
  void give_back(const Batch& batch);
  void collect(const Batch& batch);
  void choose_grid(std::size_t query_count);
  void sort_by_rotation();
  void copy_columns();
  std::uint64_t sum_at(const SortedVote& query);
  void add_rows(const RotationBox& box);

  std::uint32_t coarse(std::uint32_t level) const { return (level * grid_) >> 8U; }
  std::uint32_t rotation_cell(std::uint32_t chart, std::uint32_t a, std::uint32_t b,
                              std::uint32_t c) const {
    return ((chart * grid_ + a) * grid_ + b) * grid_ + c;
  }

  const SortedVotes& queries_;
  const SortedVotes& others_;
  std::vector<std::uint64_t>& sums_;
  CellSearch search_;
  Kernel kernel_;
  RotationReach reach_;
  std::vector<std::uint32_t> near_;        ///< others within sigma_t of the batch's box
  std::uint32_t grid_ = 0;                 ///< rotation cells per axis; 0: no grid
  std::vector<std::uint32_t> cell_begin_;  ///< of the rotation cells, in the columns
  std::vector<std::uint32_t> order_;       ///< near_ by rotation cell: what the columns hold
  std::vector<float> buffer_;              ///< behind columns_
  VoteColumns columns_{};
  std::vector<std::uint32_t> back_;  ///< per column: what the queries weigh there, not yet given
  std::vector<ScanRange> ranges_;
};

/// Adds what the queries weigh at the votes of other cells; those of their own ask themselves.
void BatchWorker::give_back(const Batch& batch) {
  const std::uint32_t own_end = queries_.cell_begin[batch.cell + 1];
  for (std::size_t i = 0; i + kScanPadding < back_.size(); ++i) {
    if (back_[i] != 0 && order_[i] >= own_end) add(order_[i], back_[i]);
    back_[i] = 0;
  }
}

void BatchWorker::collect(const Batch& batch) {
  near_.clear();
  const std::vector<VoteRun>& runs = search_.around(queries_.cells[batch.cell]);
  // Of one set, what lies before this cell has met it already.
  const std::uint32_t first = one_set() ? queries_.cell_begin[batch.cell] : 0;
  std::size_t total = 0;
  for (const VoteRun& run : runs) total += run.end - std::min(run.end, std::max(run.begin, first));
  if (total == 0) return;
  const Box box = bounding_box(queries_, batch.begin, batch.end);
  near_.resize(total);
  std::size_t count = 0;
  for (const VoteRun& run : runs)
    for (std::uint32_t i = std::max(run.begin, first); i < run.end; ++i) {
      near_[count] = i;
      count += box.squared_distance(others_.votes[i].point) <= kernel_.max_dt2;
    }
  near_.resize(count);
}

/// Cells beyond half the number of others are wasted; for few queries sorting does not pay at all.
void BatchWorker::choose_grid(std::size_t query_count) {
  const auto count = static_cast<double>(near_.size());
  grid_ = 0;
  if (query_count < 4 || count < 64) return;
  grid_ = std::clamp(static_cast<std::uint32_t>(std::cbrt(count / 2)), 1U,
                     static_cast<std::uint32_t>(reach_.cells_per_axis));
}

void BatchWorker::sort_by_rotation() {
  if (grid_ == 0) {
    order_.swap(near_);
    return copy_columns();
  }
  const auto cell_of = [this](std::uint32_t i) {
    const RotationCode code = others_.votes[i].code;
    return rotation_cell(code >> 24U, coarse((code >> 16U) & 255U), coarse((code >> 8U) & 255U),
                         coarse(code & 255U));
  };
  // Counting sort; begin is kept one cell ahead, so that filling leaves it where it belongs.
  cell_begin_.assign(4 * grid_ * grid_ * grid_ + 2, 0);
  for (const std::uint32_t i : near_) ++cell_begin_[cell_of(i) + 2];
  for (std::size_t c = 2; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  order_.resize(near_.size());
  for (const std::uint32_t i : near_) order_[cell_begin_[cell_of(i) + 1]++] = i;
  copy_columns();
}

void BatchWorker::copy_columns() {
  const std::size_t stride = order_.size() + kScanPadding;
  if (buffer_.size() < 7 * stride) buffer_.resize(7 * stride);
  float* column = buffer_.data();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const VotePoint& p = others_.votes[order_[i]].point;
    column[i] = p.tx;
    column[stride + i] = p.ty;
    column[2 * stride + i] = p.tz;
    column[3 * stride + i] = p.qw;
    column[4 * stride + i] = p.qx;
    column[5 * stride + i] = p.qy;
    column[6 * stride + i] = p.qz;
  }
  columns_ = {column,
              column + stride,
              column + 2 * stride,
              column + 3 * stride,
              column + 4 * stride,
              column + 5 * stride,
              column + 6 * stride};
}

std::uint64_t BatchWorker::sum_at(const SortedVote& query) {
  ranges_.clear();
  if (grid_ == 0) {
    const auto count = static_cast<std::uint32_t>(order_.size());
    ranges_.push_back({0, count, 1});
    ranges_.push_back({0, count, -1});
  } else {
    const RotationBoxes boxes = rotation_boxes(query.point, reach_);
    for (int b = 0; b < boxes.count; ++b) add_rows(boxes.items[static_cast<std::size_t>(b)]);
  }
  return scan_votes(kernel_, columns_, query.point, ranges_.data(), ranges_.size(),
                    one_set() ? back_.data() : nullptr);
}

void BatchWorker::add_rows(const RotationBox& box) {
  const std::uint32_t a_end = coarse(box.high[0]) + 1, b_end = coarse(box.high[1]) + 1;
  const std::uint32_t b_begin = coarse(box.low[1]);
  const std::uint32_t row_length = coarse(box.high[2]) + 1 - coarse(box.low[2]);
  for (std::uint32_t a = coarse(box.low[0]); a < a_end; ++a) {
    const std::uint32_t* first =
        &cell_begin_[rotation_cell(box.chart, a, b_begin, coarse(box.low[2]))];
    for (std::uint32_t b = b_begin; b < b_end; ++b, first += grid_)
      if (first[0] < first[row_length]) ranges_.push_back({first[0], first[row_length], box.sign});
  }
}

}  // namespace

std::vector<std::uint64_t> density_sums(const SortedVotes& queries, const SortedVotes& others) {
  std::vector<std::uint64_t> sums(queries.size(), 0);
  const std::vector<Batch> batches = make_batches(queries);
  graph::parallel_ranges(batches.size(), 1, [&](std::size_t begin, std::size_t end) {
    BatchWorker worker(queries, others, sums);
    for (std::size_t b = begin; b < end; ++b) worker.run(batches[b]);
  });
  return sums;
}

std::vector<std::uint64_t> density_sums(const SortedVotes& votes) {
  return density_sums(votes, votes);
}

}  // namespace posevote
