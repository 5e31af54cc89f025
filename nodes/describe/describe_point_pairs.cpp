// SPDX-License-Identifier: BSD-3-Clause
// Describes a feature point p with normal n by histograms over all pairs with a neighbour p' with
// normal n' within a radius. For d = (p' - p) / |p' - p| and b = d x n / |d x n| a pair has the
// angles
//
//   (n, d)  (n', d)  (n, n')  (n', b)
//
// The first three are those of point-pair features (Drost et al. 2010); the fourth tells left from
// right, as in point feature histograms (Rusu et al. 2008). Each is counted in a histogram of
// 6 distances x 10 angles by linear interpolation. Each distance row is brought to the sum
// (row + 1/2) / 6, as if the surface was a plane, whatever the sampling there, and square-rooted,
// so that the Euclidean distance is the Hellinger distance. 240 numbers; rotation changes nothing,
// reflection does.
//
// Only neighbours that face the same side count, n . n' >= `min_facing`: where p is seen, those
// may be seen too, while a scan lacks the far side of the object that a model has.
//
// Of a depth image only every `image_step`-th point is a neighbour: pixels side by side err alike,
// so that more of them cost time and tell nothing. Of laser scans and of models all are.
//
// Left out are feature points without a usable normal or with fewer than `min_neighbours` such
// neighbours. Time: O(feature points x neighbours).
//
//   describe_point_pairs: {in: [cloud, points, scale], out: features, radius: 25}
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "nodes/describe/point_pair_sums.hpp"
#include "nodes/descriptors/distance_histogram.hpp"
#include "nodes/descriptors/feature_set.hpp"
#include "nodes/descriptors/register_descriptor.hpp"
#include "nodes/geometry/grid_normals.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 25;
  double min_facing = 0.2;
  int min_neighbours = 10;
  int image_step = 3;
};

constexpr int kAngles = PointPairSums::kAngles;
constexpr int kRows = PointPairSums::kDistanceBins;
constexpr int kColumns = PointPairSums::kAngleBins;
constexpr int kLength = kAngles * kRows * kColumns;

/// The histograms, margins folded back into the first and the last bins.
using Histograms = std::array<std::array<std::array<float, kColumns>, kRows>, kAngles>;

Histograms fold(const PointPairSums& pairs) {
  Histograms out{};
  const auto clamp = [](int bin, int bins) {
    return static_cast<std::size_t>(std::clamp(bin, 0, bins - 1));
  };
  for (int row = 0; row <= kRows; ++row)
    for (int angle = 0; angle < kAngles; ++angle)
      for (int column = 0; column <= kColumns; ++column) {
        const float* sums = pairs.sums[row][angle][column];
        auto& histogram = out[static_cast<std::size_t>(angle)];
        auto& near = histogram[clamp(row - 1, kRows)];
        auto& far = histogram[clamp(row, kRows)];
        near[clamp(column - 1, kColumns)] += sums[0];
        near[clamp(column, kColumns)] += sums[1];
        far[clamp(column - 1, kColumns)] += sums[2];
        far[clamp(column, kColumns)] += sums[3];
      }
  return out;
}

void write(const Histograms& histograms, float* descriptor) {
  for (const auto& histogram : histograms)
    for (int row = 0; row < kRows; ++row) {
      const auto& bins = histogram[static_cast<std::size_t>(row)];
      const float sum = std::accumulate(bins.begin(), bins.end(), 0.0F);
      descriptor = descriptors::write_row(bins, sum, row, kRows, descriptor);
    }
}

/// Writes the descriptor of one point and returns how many neighbours it is made of.
int describe(const descriptors::Support& support, const geometry::OrientedColumns& columns,
             std::uint32_t point, float min_facing, float* descriptor) {
  const Eigen::Vector3f center = support.cloud().points.row(point);
  const Eigen::Vector3f normal = support.cloud().normals.row(point);
  thread_local std::vector<geometry::GridRun> around;
  support.grid().find_runs(center, center, support.radius(), around);
  PointPairSums pairs{};
  const int count =
      add_point_pairs(columns, around.data(), around.size(),
                      {center.data(), normal.data(), support.radius(), min_facing}, pairs);
  write(fold(pairs), descriptor);
  return count;
}

FeatureSet describe_point_pairs(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                                const Params& params) {
  const int step = cloud.view.pixels.minCoeff() > 0 ? params.image_step : 1;
  const descriptors::Support support(cloud, points, scale, params.radius, step);
  const Cloud& neighbours = support.neighbours();
  const geometry::GridNormals normals(support.grid(), neighbours.normals, [&](std::uint32_t point) {
    return descriptors::is_oriented(neighbours, point);
  });
  const auto one = [&](std::uint32_t point, float* descriptor) {
    const int count = describe(support, normals.columns(), point,
                               static_cast<float>(params.min_facing), descriptor);
    return step * count >= params.min_neighbours;
  };
  return support.describe_each(kLength, one);
}

const auto registered =
    descriptors::register_descriptor<Params>(
        "describe_point_pairs", describe_point_pairs,
        "Point-pair histograms: distance against four angles (240 numbers).", 1)
        .param("min_facing", &Params::min_facing, "cosine",
               "Least n . n' of a neighbour; -1 takes all.", graph::in_range(-1, 1))
        .param("image_step", &Params::image_step, "points",
               "Of a depth image only every so many are neighbours: pixels side by side err alike.",
               graph::in_range(1, 16));

}  // namespace
}  // namespace posevote::describe
