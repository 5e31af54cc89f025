// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/exact_index.hpp"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/descriptors/descriptor_kernels.hpp"
#include "nodes/descriptors/principal_axes.hpp"

namespace posevote::descriptors {
namespace {

constexpr std::size_t kBlockQueries =
    24 * kTileQueries;                               // their scores stay in the second cache ...
constexpr std::size_t kChunkRows = 64 * kPanelRows;  // ... for this many rows at a time
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t round_up(std::size_t n, std::size_t step) { return (n + step - 1) / step * step; }

// Of a descriptor's length: no number leaves 16 bits, however the length was rounded, and no sum of
// products 32.
constexpr float kMostSteps = 32000;

/// Of a descriptor no longer than `length`. Not a number where floats are too coarse for it.
float step_of(float length) {
  const float step = length / kMostSteps;
  return length == 0 || std::isnormal(step) ? step : std::numeric_limits<float>::quiet_NaN();
}

std::int16_t in_steps(float number, float step) {
  if (!(step > 0)) return 0;
  const float steps = number / step;
  return static_cast<std::int16_t>(steps + std::copysign(0.5F, steps));
}

/// What a product of steps stands for. If not a number, no score is, and all rows are compared.
float factor_of(float step, float other_step) {
  const float factor = step * other_step;
  return step == 0 || other_step == 0 || std::isnormal(factor)
             ? factor
             : std::numeric_limits<float>::quiet_NaN();
}

/// Numbers of a descriptor two by two, the last perhaps alone.
std::size_t pairs_of(Eigen::Index columns) { return static_cast<std::size_t>(columns + 1) / 2; }

/// Rows of `matrix` from `first` on, in steps, interleaved by `width`: all first pairs, all second
/// pairs. Missing rows are zero. `step_at`(row) is that of each.
template <class StepAt>
void interleave(const DescriptorMatrix& matrix, std::size_t first, std::size_t width,
                const StepAt& step_at, Pair* out) {
  const std::size_t count = std::min(width, static_cast<std::size_t>(matrix.rows()) - first);
  std::fill_n(out, pairs_of(matrix.cols()) * width, Pair{});
  for (std::size_t r = 0; r < count; ++r) {
    const auto row = static_cast<Eigen::Index>(first + r);
    const float step = step_at(row);
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      Pair& pair = out[static_cast<std::size_t>(k / 2) * width + r];
      (k % 2 == 0 ? pair.first : pair.second) = in_steps(matrix(row, k), step);
    }
  }
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

/// Short queries, kTileQueries at a time, interleaved.
struct Tiles {
  /// `row_step`: of the rows that they are compared with.
  Tiles(const DescriptorMatrix& queries, float row_step)
      : count(round_up(static_cast<std::size_t>(queries.rows()), kTileQueries) / kTileQueries),
        size(kTileQueries * pairs_of(queries.cols())),
        pairs(count * size),
        factors(count * kTileQueries, 0) {
    const auto step_at = [&](Eigen::Index row) { return step_of(queries.row(row).norm()); };
    for (std::size_t tile = 0; tile < count; ++tile)
      interleave(queries, tile * kTileQueries, kTileQueries, step_at, pairs.data() + tile * size);
    for (Eigen::Index q = 0; q < queries.rows(); ++q)
      factors[static_cast<std::size_t>(q)] = factor_of(step_at(q), row_step);
  }

  std::size_t count, size;
  std::vector<Pair> pairs;
  std::vector<float> factors;  ///< what a product of steps stands for, per query
};

}  // namespace

struct ExactIndex::Data {
  explicit Data(DescriptorMatrix all) : rows(std::move(all)), axes(rows) {}

  DescriptorMatrix rows;
  PrincipalAxes axes;
  Eigen::ArrayXf half_squared_norm;          ///< |b|^2 / 2 of the short rows; of padding, infinity
  float longest = 0;                         ///< largest |b| of them
  float step = 0;                            ///< of the short rows
  hwy::AlignedFreeUniquePtr<Pair[]> panels;  ///< kPanelRows short rows at a time, interleaved

  std::size_t pairs() const { return pairs_of(axes.length()); }
  std::size_t length() const { return static_cast<std::size_t>(axes.length()); }
  std::size_t count() const { return static_cast<std::size_t>(rows.rows()); }
  float error(float query_length) const;
  void score(const Tiles& queries, std::size_t first, std::size_t row_count, float* scores) const;
  void match_block(const DescriptorRows& queries, std::size_t first, std::size_t query_count,
                   TwoNearest* out) const;
};

/// The largest error of a score: of rounding (Higham, Accuracy and Stability, section 3.1), what
/// the short descriptors may have moved, and what each of two loses in steps: half of one a number.
float ExactIndex::Data::error(float query_length) const {
  const float unit = std::numeric_limits<float>::epsilon();  // twice the unit of rounding: generous
  const float both = query_length + longest;
  const float rounding = static_cast<float>(length() + 8) * unit + PrincipalAxes::kMoves;
  const float lost = 0.51F * std::sqrt(static_cast<float>(length())) / kMostSteps;
  return rounding * both * both + lost * (2 + lost) * query_length * longest +
         std::numeric_limits<float>::min();
}

void ExactIndex::Data::score(const Tiles& queries, std::size_t first, std::size_t row_count,
                             float* scores) const {
  for (std::size_t r = 0; r < row_count; r += kPanelRows)
    for (std::size_t tile = 0; tile < queries.count; ++tile)
      score_panel(
          queries.pairs.data() + tile * queries.size, queries.factors.data() + tile * kTileQueries,
          panels.get() + (first + r) * pairs(), pairs(), half_squared_norm.data() + first + r,
          scores + tile * kTileQueries * kChunkRows + r, kChunkRows);
}

void ExactIndex::Data::match_block(const DescriptorRows& queries, std::size_t first,
                                   std::size_t query_count, TwoNearest* out) const {
  const DescriptorMatrix brief = axes.shorten(queries, static_cast<Eigen::Index>(first),
                                              static_cast<Eigen::Index>(query_count));
  const Tiles tiles(brief, step);
  std::vector<Search> searches;
  for (std::size_t q = 0; q < query_count; ++q) {
    const auto i = static_cast<Eigen::Index>(q);
    const float* query = queries.row(static_cast<Eigen::Index>(first + q)).data();
    searches.emplace_back(rows, query, brief.row(i).cast<double>().squaredNorm(),
                          error(brief.row(i).norm()));
  }
  std::vector<float> scores(tiles.count * kTileQueries * kChunkRows + kKernelPadding);
  std::vector<std::uint32_t> places(kChunkRows + kKernelPadding);
  for (std::size_t row = 0; row < count(); row += kChunkRows) {
    const std::size_t row_count = std::min(kChunkRows, count() - row);
    score(tiles, row, row_count, scores.data());
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
  data->step = step_of(data->longest);
  data->panels = hwy::AllocateAligned<Pair>(padded * data->pairs());
  for (std::size_t row = 0; row < padded; row += kPanelRows)
    interleave(
        brief, row, kPanelRows, [&](Eigen::Index) { return data->step; },
        data->panels.get() + row * data->pairs());
  data_ = std::move(data);
}

ExactIndex::~ExactIndex() = default;

std::vector<TwoNearest> ExactIndex::nearest_two(const DescriptorRows& queries) const {
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
