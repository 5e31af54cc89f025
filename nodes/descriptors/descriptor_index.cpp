// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/descriptor_index.hpp"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_index.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/descriptors/descriptor_kernels.hpp"
#include "nodes/descriptors/exact_index.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::descriptors {
namespace {

using Metric = flann::L2<float>;
using FlannIndex = flann::NNIndex<Metric>;

/// A view; FLANN's type has no const form, but none of the functions used here writes through it.
flann::Matrix<float> view(const DescriptorRows& rows) {
  return {const_cast<float*>(rows.data()), static_cast<std::size_t>(rows.rows()),
          static_cast<std::size_t>(rows.cols()),
          static_cast<std::size_t>(rows.outerStride()) * sizeof(float)};
}

DescriptorMatrix stack(const std::vector<DescriptorRows>& matrices) {
  Eigen::Index rows = 0, columns = 0;
  for (const DescriptorRows& matrix : matrices) {
    if (matrix.rows() == 0) continue;
    if (rows > 0 && matrix.cols() != columns)
      throw std::runtime_error("descriptors of " + std::to_string(matrix.cols()) + " and of " +
                               std::to_string(columns) + " numbers cannot share an index");
    columns = matrix.cols();
    rows += matrix.rows();
  }
  if (rows == 0 || columns == 0) throw std::runtime_error("there are no descriptors to search");
  if (rows >= std::numeric_limits<int>::max())
    throw std::runtime_error("too many descriptors for one index: " + std::to_string(rows));
  DescriptorMatrix stacked(rows, columns);
  Eigen::Index row = 0;
  for (const DescriptorRows& matrix : matrices) {
    if (matrix.rows() == 0) continue;
    stacked.middleRows(row, matrix.rows()) = matrix;
    row += matrix.rows();
  }
  return stacked;
}

void require_finite(const DescriptorRows& matrix, const char* whose) {
  constexpr std::size_t kGrain = 512;  // rows are long
  const auto is_bad = [&matrix](std::uint32_t i) { return !matrix.row(i).allFinite(); };
  if (!geometry::rows_that(static_cast<std::size_t>(matrix.rows()), is_bad, kGrain).empty())
    throw std::runtime_error(std::string(whose) + " descriptors hold values that are not finite");
}

void require_valid(const IndexOptions& options) {
  const auto require_at_least = [](const char* name, int value, int least) {
    if (value < least)
      throw std::runtime_error(std::string(name) + " is " + std::to_string(value) +
                               ", expected at least " + std::to_string(least));
  };
  if (options.search != "exact" && options.search != "kd_tree" && options.search != "approximate")
    throw std::runtime_error("unknown search '" + options.search +
                             "', expected exact, kd_tree or approximate");
  require_at_least("trees", options.trees, 1);
  if (options.trees > 64)
    throw std::runtime_error("trees is " + std::to_string(options.trees) + ", expected at most 64");
  require_at_least("checks", options.checks, 2);
}

std::string text_of(const Blocks& blocks) {
  if (blocks.empty()) return "one descriptor";
  std::string text = "blocks of";
  for (const std::uint32_t width : blocks) text += " " + std::to_string(width);
  return text;
}

void require_blocks(const Blocks& blocks, Eigen::Index columns) {
  std::uint64_t sum = 0;
  for (const std::uint32_t width : blocks) {
    if (width == 0) throw std::runtime_error("a block of a descriptor has no columns");
    sum += width;
  }
  if (!blocks.empty() && sum != static_cast<std::uint64_t>(columns))
    throw std::runtime_error("descriptors of " + std::to_string(columns) + " numbers in " +
                             text_of(blocks));
}

std::unique_ptr<FlannIndex> build_flann(const DescriptorMatrix& rows, const IndexOptions& options) {
  const flann::Matrix<float> points = view(rows);
  std::unique_ptr<FlannIndex> index;
  if (options.search == "kd_tree")
    index = std::make_unique<flann::KDTreeSingleIndex<Metric>>(points);
  else
    index = std::make_unique<flann::KDTreeIndex<Metric>>(points,
                                                         flann::KDTreeIndexParams(options.trees));
  index->buildIndex();
  return index;
}

/// The rows of one descriptor, and how they are searched.
class BlockIndex {
 public:
  BlockIndex(DescriptorMatrix rows, const IndexOptions& options) : options_(options) {
    if (options.search == "exact") {
      exact_ = std::make_unique<ExactIndex>(std::move(rows));
    } else {
      rows_ = std::move(rows);
      flann_ = build_flann(rows_, options);
    }
  }

  std::vector<TwoNearest> nearest_two(const DescriptorRows& queries) const {
    if (exact_) return exact_->nearest_two(queries);
    std::vector<TwoNearest> nearest(static_cast<std::size_t>(queries.rows()));
    graph::parallel_for(nearest.size(), 16, [&](std::size_t query) {
      nearest[query] = search_flann(queries, static_cast<Eigen::Index>(query));
    });
    return nearest;
  }

 private:
  TwoNearest search_flann(const DescriptorRows& queries, Eigen::Index query) const;

  IndexOptions options_;
  std::unique_ptr<ExactIndex> exact_;  ///< either this
  DescriptorMatrix rows_;              ///< or these, to which FLANN keeps a pointer
  std::unique_ptr<FlannIndex> flann_;
};

TwoNearest BlockIndex::search_flann(const DescriptorRows& queries, Eigen::Index query) const {
  const bool exact = options_.search == "kd_tree";
  const flann::SearchParams params(exact ? flann::FLANN_CHECKS_UNLIMITED : options_.checks);
  const flann::Matrix<float> one = view(queries.middleRows(query, 1));
  std::vector<std::vector<std::size_t>> found;
  std::vector<std::vector<float>> squared;
  flann_->knnSearch(one, found, squared,
                    static_cast<std::size_t>(std::min<Eigen::Index>(2, rows_.rows())), params);
  // FLANN's sums are in float and it returns any of equally near rows, so the exact answer takes
  // all rows that are as near as the second, and a little more.
  if (exact)
    flann_->radiusSearch(one, found, squared, 1.0001F * squared[0].back() + 1e-30F, params);
  BestTwo best;
  for (const std::size_t row : found[0])
    best.offer(
        squared_distance(queries.row(query).data(), &rows_(static_cast<Eigen::Index>(row), 0),
                         static_cast<std::size_t>(rows_.cols())),
        static_cast<std::uint32_t>(row));
  return best.result();
}

/// Calls visit(block of the matrix) for each of its blocks.
template <class Visit>
void for_each_block(const DescriptorRows& matrix, const Blocks& blocks, const Visit& visit) {
  Eigen::Index first = 0;
  for (const std::uint32_t width : blocks) {
    visit(DescriptorRows(matrix.middleCols(first, width)));
    first += width;
  }
}

}  // namespace

struct DescriptorIndex::Data {
  IndexOptions options;
  Blocks blocks;  ///< empty: one descriptor
  Eigen::Index columns = 0;
  std::vector<std::unique_ptr<const BlockIndex>> indices;
};

DescriptorIndex::DescriptorIndex(const std::vector<DescriptorRows>& matrices, IndexOptions options,
                                 Blocks blocks) {
  require_valid(options);
  DescriptorMatrix rows = stack(matrices);
  require_finite(rows, "the models'");
  require_blocks(blocks, rows.cols());
  auto data = std::make_unique<Data>();
  data->columns = rows.cols();
  const auto add = [&](DescriptorMatrix block) {
    data->indices.push_back(std::make_unique<const BlockIndex>(std::move(block), options));
  };
  if (blocks.empty())
    add(std::move(rows));
  else
    for_each_block(rows, blocks, add);
  data->options = std::move(options);
  data->blocks = std::move(blocks);
  data_ = std::move(data);
}

DescriptorIndex::~DescriptorIndex() = default;

std::vector<TwoNearest> DescriptorIndex::nearest_two(const DescriptorRows& queries,
                                                     const Blocks& blocks) const {
  if (queries.rows() == 0) return {};
  if (queries.cols() != data_->columns)
    throw std::runtime_error("the scene's descriptors have " + std::to_string(queries.cols()) +
                             " numbers, the library's " + std::to_string(data_->columns));
  if (blocks != data_->blocks)
    throw std::runtime_error("the scene's features are " + text_of(blocks) + ", the library's " +
                             text_of(data_->blocks));
  require_finite(queries, "the scene's");
  if (blocks.empty()) return data_->indices[0]->nearest_two(queries);
  std::vector<TwoNearest> best;
  std::size_t number = 0;
  for_each_block(queries, blocks, [&](const DescriptorRows& block) {
    std::vector<TwoNearest> nearest = data_->indices[number++]->nearest_two(block);
    if (best.empty()) return best.swap(nearest);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (squared_ratio(nearest[i]) < squared_ratio(best[i])) best[i] = nearest[i];
  });
  return best;
}

const IndexOptions& DescriptorIndex::options() const { return data_->options; }

bool DescriptorIndex::reproducible() const { return data_->options.search != "approximate"; }

namespace {

void require_alike(const std::vector<std::shared_ptr<const Model>>& models) {
  for (const auto& model : models)
    if (model->features.blocks != models[0]->features.blocks)
      throw std::runtime_error("the features of '" + models[0]->name + "' are " +
                               text_of(models[0]->features.blocks) + ", those of '" + model->name +
                               "' " + text_of(model->features.blocks));
}

/// The rows of all models at one scale.
LibraryOctave index_octave(const std::vector<std::shared_ptr<const Model>>& models,
                           float resolution, const IndexOptions& options) {
  LibraryOctave octave;
  octave.resolution = resolution;
  std::vector<DescriptorRows> matrices;
  std::uint32_t first = 0;
  for (std::uint32_t m = 0; m < models.size(); ++m)
    for (const Octave& rows : octaves_of(models[m]->features)) {
      if (rows.resolution != resolution || rows.begin == rows.end) continue;
      octave.rows.push_back({m, rows.begin, first});
      matrices.push_back(descriptors_of(models[m]->features, rows));
      first += rows.end - rows.begin;
    }
  octave.index =
      std::make_shared<const DescriptorIndex>(matrices, options, models[0]->features.blocks);
  return octave;
}

}  // namespace

std::vector<LibraryOctave> index_octaves(const std::vector<std::shared_ptr<const Model>>& models,
                                         const IndexOptions& options) {
  require_alike(models);
  std::set<float> resolutions;
  for (const auto& model : models)
    for (const Octave& rows : octaves_of(model->features))
      if (rows.begin < rows.end) resolutions.insert(rows.resolution);
  if (resolutions.empty()) throw std::runtime_error("there are no descriptors to search");
  std::vector<LibraryOctave> octaves;
  for (const float resolution : resolutions)
    octaves.push_back(index_octave(models, resolution, options));
  return octaves;
}

}  // namespace posevote::descriptors
