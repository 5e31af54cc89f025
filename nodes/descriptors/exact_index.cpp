// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/exact_index.hpp"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/descriptors/descriptor_kernels.hpp"
#include "nodes/descriptors/principal_axes.hpp"

namespace posevote::descriptors {
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

/// The nearest two rows of one query, found chunk by chunk. The score of a row is |b|^2 / 2 - ab of
/// short descriptors: half their squared distance, less what all rows have in common.
class Search {
 public:
  /// `error`: what a score may be off.
  Search(const DescriptorMatrix& rows, const float* query, double squared_norm, float error)
      : rows_(&rows), query_(query), squared_norm_(squared_norm), error_(error) {}

  /// `places`: room for those of all scores.
  void look(const float* scores, std::size_t count, std::size_t first_row,
            std::vector<std::uint32_t>& places) {
    if (first_row == 0) seed(scores, count, places);
    const std::size_t found = find_low(scores, count, limit_, places.data());
    for (std::size_t i = 0; i < found; ++i) {
      if (scores[places[i]] > limit_) continue;
      offer(best_, first_row + places[i]);
      limit_ = std::min(limit_, limit(best_));
    }
  }
  TwoNearest result() const { return best_.result(); }

 private:
  /// A first limit: that of the rows with the lowest scores.
  void seed(const float* scores, std::size_t count, std::vector<std::uint32_t>& places) {
    BestTwo lowest;
    const std::size_t found = find_low(scores, count, second_lowest(scores, count), places.data());
    for (std::size_t i = 0; i < found; ++i) offer(lowest, places[i]);
    limit_ = limit(lowest);
  }
  void offer(BestTwo& best, std::size_t row) const {
    best.offer(squared_distance(query_, &(*rows_)(static_cast<Eigen::Index>(row), 0),
                                static_cast<std::size_t>(rows_->cols())),
               static_cast<std::uint32_t>(row));
  }
  /// No row with a higher score is among the nearest two.
  float limit(const BestTwo& best) const {
    return static_cast<float>((best.second_squared() - squared_norm_) / 2) + error_;
  }

  const DescriptorMatrix* rows_;
  const float* query_;
  double squared_norm_;  ///< of the short query
  float error_;
  float limit_ = kInfinity;
  BestTwo best_;
};

}  // namespace

struct ExactIndex::Data {
  explicit Data(DescriptorMatrix all) : rows(std::move(all)), axes(rows) {}

  DescriptorMatrix rows;
  PrincipalAxes axes;
  Eigen::ArrayXf half_squared_norm;           ///< |b|^2 / 2 of the short rows; of padding, infinity
  float longest = 0;                          ///< largest |b| of them
  hwy::AlignedFreeUniquePtr<float[]> panels;  ///< kPanelRows short rows at a time, interleaved

  std::size_t length() const { return static_cast<std::size_t>(axes.length()); }
  std::size_t count() const { return static_cast<std::size_t>(rows.rows()); }
  float error(float query_length) const;
  void score(const float* packed, std::size_t tiles, std::size_t first, std::size_t row_count,
             float* scores) const;
  void match_block(const DescriptorMatrix& queries, std::size_t first, std::size_t query_count,
                   TwoNearest* out) const;
};

/// The largest error of a score (Higham, Accuracy and Stability, section 3.1), and what the short
/// descriptors may have moved.
float ExactIndex::Data::error(float query_length) const {
  const float unit = std::numeric_limits<float>::epsilon();  // twice the unit of rounding: generous
  const float both = query_length + longest;
  const float rounding = static_cast<float>(length() + 8) * unit + PrincipalAxes::kMoves;
  return rounding * both * both + std::numeric_limits<float>::min();
}

void ExactIndex::Data::score(const float* packed, std::size_t tiles, std::size_t first,
                             std::size_t row_count, float* scores) const {
  for (std::size_t r = 0; r < row_count; r += kPanelRows)
    for (std::size_t tile = 0; tile < tiles; ++tile)
      score_panel(packed + tile * kTileQueries * length(), panels.get() + (first + r) * length(),
                  length(), half_squared_norm.data() + first + r,
                  scores + tile * kTileQueries * kChunkRows + r, kChunkRows);
}

void ExactIndex::Data::match_block(const DescriptorMatrix& queries, std::size_t first,
                                   std::size_t query_count, TwoNearest* out) const {
  const DescriptorMatrix brief = axes.shorten(queries, static_cast<Eigen::Index>(first),
                                              static_cast<Eigen::Index>(query_count));
  const std::size_t tiles = round_up(query_count, kTileQueries) / kTileQueries;
  std::vector<float> packed(tiles * kTileQueries * length());
  for (std::size_t tile = 0; tile < tiles; ++tile)
    interleave(brief, tile * kTileQueries, kTileQueries,
               packed.data() + tile * kTileQueries * length());
  std::vector<Search> searches;
  for (std::size_t q = 0; q < query_count; ++q) {
    const auto i = static_cast<Eigen::Index>(q);
    const float* query = &queries(static_cast<Eigen::Index>(first + q), 0);
    searches.emplace_back(rows, query, brief.row(i).cast<double>().squaredNorm(),
                          error(brief.row(i).norm()));
  }
  std::vector<float> scores(tiles * kTileQueries * kChunkRows + kKernelPadding);
  std::vector<std::uint32_t> places(kChunkRows + kKernelPadding);
  for (std::size_t row = 0; row < count(); row += kChunkRows) {
    const std::size_t row_count = std::min(kChunkRows, count() - row);
    score(packed.data(), tiles, row, row_count, scores.data());
    for (std::size_t q = 0; q < query_count; ++q)
      searches[q].look(scores.data() + q * kChunkRows, row_count, row, places);
  }
  for (std::size_t q = 0; q < query_count; ++q) out[first + q] = searches[q].result();
}

ExactIndex::ExactIndex(DescriptorMatrix rows) {
  auto data = std::make_unique<Data>(std::move(rows));
  const DescriptorMatrix brief = data->axes.shorten(data->rows, 0, data->rows.rows());
  const std::size_t padded = round_up(data->count(), kPanelRows);
  data->half_squared_norm.setConstant(static_cast<Eigen::Index>(padded), kInfinity);
  data->half_squared_norm.head(brief.rows()) =
      (brief.cast<double>().rowwise().squaredNorm() / 2).cast<float>();
  data->longest = brief.rowwise().norm().maxCoeff();
  data->panels = hwy::AllocateAligned<float>(padded * data->length());
  for (std::size_t row = 0; row < padded; row += kPanelRows)
    interleave(brief, row, kPanelRows, data->panels.get() + row * data->length());
  data_ = std::move(data);
}

ExactIndex::~ExactIndex() = default;

std::vector<TwoNearest> ExactIndex::nearest_two(const DescriptorMatrix& queries) const {
  const auto count = static_cast<std::size_t>(queries.rows());
  std::vector<TwoNearest> nearest(count);
  const std::size_t blocks = round_up(count, kBlockQueries) / kBlockQueries;
  graph::parallel_for(blocks, 1, [&](std::size_t block) {
    const std::size_t first = block * kBlockQueries;
    data_->match_block(queries, first, std::min(kBlockQueries, count - first), nearest.data());
  });
  return nearest;
}

}  // namespace posevote::descriptors
