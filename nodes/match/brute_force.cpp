// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/match/brute_force.hpp"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/match/dot_products.hpp"

namespace posevote {
namespace {

constexpr std::size_t kBlockQueries =
    16 * kTileQueries;                               // their scores stay in the second cache ...
constexpr std::size_t kChunkRows = 64 * kPanelRows;  // ... for this many rows at a time
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t round_up(std::size_t n, std::size_t step) { return (n + step - 1) / step * step; }

/// Rows of `matrix` from `first` on, interleaved by `width`: all first columns, all second columns.
/// Missing rows are zero.
void interleave(const DescriptorMatrix& matrix, std::size_t first, std::size_t width, float* out) {
  const auto columns = static_cast<std::size_t>(matrix.cols());
  const std::size_t count = std::min(width, static_cast<std::size_t>(matrix.rows()) - first);
  for (std::size_t k = 0; k < columns; ++k)
    for (std::size_t r = 0; r < width; ++r)
      out[k * width + r] =
          r < count ? matrix(static_cast<Eigen::Index>(first + r), static_cast<Eigen::Index>(k))
                    : 0;
}

/// Rows that may be among the nearest two of one query, found chunk by chunk. The score of a row is
/// |b|^2 / 2 - ab: half its squared distance, less what all rows have in common.
class Candidates {
 public:
  explicit Candidates(float window) : window_(window) {}

  void add(const float* scores, std::size_t count, std::uint32_t first_row) {
    lower_best(scores, count);
    const float limit = second_ + window_;
    for (std::size_t r = 0; r < count; ++r)
      if (!(scores[r] > limit))  // so that an overflow to NaN makes a candidate too
        found_.emplace_back(scores[r], first_row + static_cast<std::uint32_t>(r));
  }
  template <class Use>
  void visit(const Use& use) const {
    for (const auto& [score, row] : found_)
      if (!(score > second_ + window_)) use(row);
  }

 private:
  void lower_best(const float* scores, std::size_t count) {
    constexpr Eigen::Index kLanes = 16;
    using Lanes = Eigen::Array<float, kLanes, 1>;
    Lanes best = Lanes::Constant(best_), second = Lanes::Constant(second_);
    // Lane 0 carries what is known; the others must not hold the same row once more.
    best.tail<kLanes - 1>().setConstant(kInfinity);
    second.tail<kLanes - 1>().setConstant(kInfinity);
    std::size_t r = 0;
    for (; r + kLanes <= count; r += kLanes) {
      const Lanes score = Eigen::Map<const Lanes>(scores + r);
      second = second.min(best.max(score));
      best = best.min(score);
    }
    for (; r < count; ++r) {
      second[0] = std::min(second[0], std::max(best[0], scores[r]));
      best[0] = std::min(best[0], scores[r]);
    }
    best_ = second_ = kInfinity;
    for (Eigen::Index lane = 0; lane < kLanes; ++lane)
      for (const float score : {best[lane], second[lane]}) {
        second_ = std::min(second_, std::max(best_, score));
        best_ = std::min(best_, score);
      }
  }

  float window_;
  float best_ = kInfinity, second_ = kInfinity;
  std::vector<std::pair<float, std::uint32_t>> found_;
};

}  // namespace

struct BruteForce::Data {
  DescriptorMatrix rows;
  Eigen::ArrayXf half_squared_norm;           ///< |b|^2 / 2, padded to whole panels
  float longest = 0;                          ///< largest |b|
  hwy::AlignedFreeUniquePtr<float[]> panels;  ///< kPanelRows rows after one another, interleaved

  std::size_t dimension() const { return static_cast<std::size_t>(rows.cols()); }
  std::size_t count() const { return static_cast<std::size_t>(rows.rows()); }
  const float* panel(std::size_t row) const { return panels.get() + row * dimension(); }
  float window(Eigen::Index query, const DescriptorMatrix& queries) const;
  void score(const float* packed, std::size_t tiles, std::size_t first, std::size_t count,
             float* scores) const;
  void match_block(const DescriptorMatrix& queries, std::size_t first, std::size_t count,
                   TwoNearest* out) const;
};

/// Twice the largest error of a score (Higham, Accuracy and Stability, section 3.1): no row whose
/// score exceeds the second best by more can be among the nearest two.
float BruteForce::Data::window(Eigen::Index query, const DescriptorMatrix& queries) const {
  const float length = queries.row(query).norm();
  const float unit = std::numeric_limits<float>::epsilon();  // twice the unit of rounding: generous
  const float error = static_cast<float>(rows.cols() + 8) * unit * longest * (length + longest);
  return error + std::numeric_limits<float>::min();
}

void BruteForce::Data::score(const float* packed, std::size_t tiles, std::size_t first,
                             std::size_t row_count, float* scores) const {
  const std::size_t stride = kChunkRows;
  for (std::size_t r = 0; r < row_count; r += kPanelRows)
    for (std::size_t tile = 0; tile < tiles; ++tile)
      multiply_panel(packed + tile * kTileQueries * dimension(), panel(first + r), dimension(),
                     scores + tile * kTileQueries * stride + r, stride);
  const auto length = static_cast<Eigen::Index>(row_count);
  const auto norms = half_squared_norm.segment(static_cast<Eigen::Index>(first), length);
  for (std::size_t q = 0; q < tiles * kTileQueries; ++q) {
    Eigen::Map<Eigen::ArrayXf> products(scores + q * stride, length);
    products = norms - products;
  }
}

void BruteForce::Data::match_block(const DescriptorMatrix& queries, std::size_t first,
                                   std::size_t query_count, TwoNearest* out) const {
  const std::size_t tiles = round_up(query_count, kTileQueries) / kTileQueries;
  std::vector<float> packed(tiles * kTileQueries * dimension());
  for (std::size_t tile = 0; tile < tiles; ++tile)
    interleave(queries, first + tile * kTileQueries, kTileQueries,
               packed.data() + tile * kTileQueries * dimension());
  std::vector<Candidates> candidates;
  for (std::size_t q = 0; q < query_count; ++q)
    candidates.emplace_back(window(static_cast<Eigen::Index>(first + q), queries));
  std::vector<float> scores(tiles * kTileQueries * kChunkRows);
  for (std::size_t row = 0; row < count(); row += kChunkRows) {
    const std::size_t length = std::min(kChunkRows, count() - row);
    score(packed.data(), tiles, row, round_up(length, kPanelRows), scores.data());
    for (std::size_t q = 0; q < query_count; ++q)
      candidates[q].add(scores.data() + q * kChunkRows, length, static_cast<std::uint32_t>(row));
  }
  for (std::size_t q = 0; q < query_count; ++q) {
    const auto query = static_cast<Eigen::Index>(first + q);
    BestTwo best;
    candidates[q].visit([&](std::uint32_t row) {
      best.offer(squared_distance(&queries(query, 0), &rows(row, 0), rows.cols()), row);
    });
    out[first + q] = best.result();
  }
}

BruteForce::BruteForce(const DescriptorMatrix& rows) {
  auto data = std::make_unique<Data>();
  data->rows = rows;
  const std::size_t padded = round_up(data->count(), kPanelRows);
  data->half_squared_norm.setZero(static_cast<Eigen::Index>(padded));
  data->half_squared_norm.head(rows.rows()) =
      (rows.cast<double>().rowwise().squaredNorm() / 2).cast<float>();
  data->longest = std::sqrt(2 * data->half_squared_norm.maxCoeff());
  data->panels = hwy::AllocateAligned<float>(padded * data->dimension());
  for (std::size_t row = 0; row < padded; row += kPanelRows)
    interleave(rows, row, kPanelRows, data->panels.get() + row * data->dimension());
  data_ = std::move(data);
}

BruteForce::~BruteForce() = default;

std::vector<TwoNearest> BruteForce::nearest_two(const DescriptorMatrix& queries) const {
  const auto count = static_cast<std::size_t>(queries.rows());
  std::vector<TwoNearest> nearest(count);
  const std::size_t blocks = round_up(count, kBlockQueries) / kBlockQueries;
  graph::parallel_for(blocks, 1, [&](std::size_t block) {
    const std::size_t first = block * kBlockQueries;
    data_->match_block(queries, first, std::min(kBlockQueries, count - first), nearest.data());
  });
  return nearest;
}

}  // namespace posevote
