// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/match/descriptor_index.hpp"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_index.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "graph/parallel.hpp"
#include "nodes/match/brute_force.hpp"

namespace posevote {
namespace {

using Metric = flann::L2<float>;
using FlannIndex = flann::NNIndex<Metric>;

/// A view; FLANN's type has no const form, but none of the functions used here writes through it.
flann::Matrix<float> view(const DescriptorMatrix& matrix, Eigen::Index first, Eigen::Index count) {
  return {const_cast<float*>(matrix.data() + first * matrix.cols()),
          static_cast<std::size_t>(count), static_cast<std::size_t>(matrix.cols())};
}

DescriptorMatrix stack(const std::vector<const DescriptorMatrix*>& blocks) {
  Eigen::Index rows = 0, columns = 0;
  for (const DescriptorMatrix* block : blocks) {
    if (block->rows() == 0) continue;
    if (rows > 0 && block->cols() != columns)
      throw std::runtime_error("descriptors of " + std::to_string(block->cols()) + " and of " +
                               std::to_string(columns) + " numbers cannot share an index");
    columns = block->cols();
    rows += block->rows();
  }
  if (rows == 0 || columns == 0) throw std::runtime_error("there are no descriptors to search");
  if (rows >= std::numeric_limits<int>::max())
    throw std::runtime_error("too many descriptors for one index: " + std::to_string(rows));
  DescriptorMatrix stacked(rows, columns);
  Eigen::Index row = 0;
  for (const DescriptorMatrix* block : blocks) {
    if (block->rows() == 0) continue;
    stacked.middleRows(row, block->rows()) = *block;
    row += block->rows();
  }
  return stacked;
}

void require_finite(const DescriptorMatrix& matrix, const char* whose) {
  if (!matrix.allFinite())
    throw std::runtime_error(std::string(whose) + " descriptors hold values that are not finite");
}

std::unique_ptr<FlannIndex> build_flann(const DescriptorMatrix& rows, const IndexOptions& options) {
  const flann::Matrix<float> points = view(rows, 0, rows.rows());
  std::unique_ptr<FlannIndex> index;
  if (options.search == "kd_tree")
    index = std::make_unique<flann::KDTreeSingleIndex<Metric>>(points);
  else if (options.search == "approximate")
    index = std::make_unique<flann::KDTreeIndex<Metric>>(points,
                                                         flann::KDTreeIndexParams(options.trees));
  else
    throw std::runtime_error("unknown search '" + options.search +
                             "', expected exact, kd_tree or approximate");
  index->buildIndex();
  return index;
}

}  // namespace

struct DescriptorIndex::Data {
  IndexOptions options;
  DescriptorMatrix rows;
  std::unique_ptr<BruteForce> brute_force;  ///< either this
  std::unique_ptr<FlannIndex> flann;        ///< or this

  TwoNearest search_flann(const DescriptorMatrix& queries, Eigen::Index query) const;
};

TwoNearest DescriptorIndex::Data::search_flann(const DescriptorMatrix& queries,
                                               Eigen::Index query) const {
  const bool exact = options.search == "kd_tree";
  const flann::SearchParams params(exact ? flann::FLANN_CHECKS_UNLIMITED : options.checks);
  const flann::Matrix<float> one = view(queries, query, 1);
  std::vector<std::vector<std::size_t>> found;
  std::vector<std::vector<float>> squared;
  flann->knnSearch(one, found, squared,
                   static_cast<std::size_t>(std::min<Eigen::Index>(2, rows.rows())), params);
  // FLANN's sums are in float and it returns any of equally near rows, so the exact answer takes
  // all rows that are as near as the second, and a little more.
  if (exact) flann->radiusSearch(one, found, squared, 1.0001F * squared[0].back() + 1e-30F, params);
  BestTwo best;
  for (const std::size_t row : found[0])
    best.offer(
        squared_distance(&queries(query, 0), &rows(static_cast<Eigen::Index>(row), 0), rows.cols()),
        static_cast<std::uint32_t>(row));
  return best.result();
}

DescriptorIndex::DescriptorIndex(const std::vector<const DescriptorMatrix*>& blocks,
                                 IndexOptions options) {
  auto data = std::make_unique<Data>();
  data->options = std::move(options);
  data->rows = stack(blocks);
  require_finite(data->rows, "the models'");
  if (data->options.search == "exact")
    data->brute_force = std::make_unique<BruteForce>(data->rows);
  else
    data->flann = build_flann(data->rows, data->options);
  data_ = std::move(data);
}

DescriptorIndex::~DescriptorIndex() = default;

std::vector<TwoNearest> DescriptorIndex::nearest_two(const DescriptorMatrix& queries) const {
  if (queries.rows() == 0) return {};
  if (queries.cols() != data_->rows.cols())
    throw std::runtime_error("the scene's descriptors have " + std::to_string(queries.cols()) +
                             " numbers, the library's " + std::to_string(data_->rows.cols()));
  require_finite(queries, "the scene's");
  if (data_->brute_force) return data_->brute_force->nearest_two(queries);
  std::vector<TwoNearest> nearest(static_cast<std::size_t>(queries.rows()));
  graph::parallel_for(nearest.size(), 16, [&](std::size_t query) {
    nearest[query] = data_->search_flann(queries, static_cast<Eigen::Index>(query));
  });
  return nearest;
}

const IndexOptions& DescriptorIndex::options() const { return data_->options; }

bool DescriptorIndex::reproducible() const { return data_->options.search != "approximate"; }

std::shared_ptr<const DescriptorIndex> index_of(
    const std::vector<std::shared_ptr<const Model>>& models, const IndexOptions& options) {
  std::vector<const DescriptorMatrix*> blocks;
  blocks.reserve(models.size());
  for (const auto& model : models) blocks.push_back(&model->features.descriptors);
  return std::make_shared<const DescriptorIndex>(blocks, options);
}

}  // namespace posevote
