// SPDX-License-Identifier: BSD-3-Clause
// NDHist: how the normals of the neighbours are turned against that of the feature point, by
// distance: a histogram of 8 distances x 16 angles (n, n'), 128 numbers. The name and the numbers
// are those of the authors of rotational subgroup voting, who give no more; the rest is ours, as in
// describe_point_pairs: counts are shared linearly between bins, each distance row is brought to
// the sum (row + 1/2) / 8, as if the surface was a plane, whatever the sampling there, and
// square-rooted, so that the Euclidean distance is the Hellinger distance. Neither a reflection nor
// the difference of a bump from a dent is seen.
//
// The authors used a radius of 20 mean edges of their meshes; on UWA's models one of those is some
// 1.27 of our resolutions.
//
// Left out are feature points without a usable normal or with fewer than `min_neighbours`
// neighbours that have one. Time: O(feature points x neighbours).
//
//   describe_nd_histogram: {in: [cloud, points, scale], out: features, radius: 25}
#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/descriptors/distance_histogram.hpp"
#include "nodes/descriptors/feature_set.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 25;
  int min_neighbours = 10;
};

constexpr int kDistances = 8, kAngles = 16;

using Histogram = Eigen::Array<float, kDistances, kAngles, Eigen::RowMajor>;

void write(const Histogram& histogram, float* descriptor) {
  for (int row = 0; row < kDistances; ++row)
    descriptor = descriptors::write_row({&histogram(row, 0), std::size_t{kAngles}},
                                        histogram.row(row).sum(), row, kDistances, descriptor);
}

/// Writes the descriptor of one point and returns how many neighbours it is made of.
int describe(const descriptors::Support& support, std::uint32_t point, float* descriptor) {
  const Cloud& cloud = support.cloud();
  const Eigen::Vector3f normal = cloud.normals.row(point).normalized();
  const float distance_bins = static_cast<float>(kDistances) / support.radius();
  Histogram histogram = Histogram::Zero();
  int count = 0;
  const auto add = [&](std::uint32_t neighbour, float squared) {
    if (!(squared > 0) || !descriptors::is_oriented(cloud, neighbour)) return;
    const Eigen::Vector3f other = cloud.normals.row(neighbour).normalized();
    const float angle = std::acos(std::clamp(normal.dot(other), -1.0F, 1.0F));
    const descriptors::Shares far(std::sqrt(squared) * distance_bins, kDistances);
    const descriptors::Shares turned(angle * static_cast<float>(kAngles / std::numbers::pi),
                                     kAngles);
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        histogram(far.bin[i], turned.bin[k]) += far.weight[i] * turned.weight[k];
    ++count;
  };
  support.grid().for_each_within(cloud.points.row(point), support.radius(), add);
  write(histogram, descriptor);
  return count;
}

FeatureSet describe_nd_histogram(const Cloud& cloud, const FeaturePoints& points,
                                 const Scale& scale, const Params& params) {
  const descriptors::Support support(cloud, points, scale, params.radius);
  return support.describe_each(kDistances * kAngles, [&](std::uint32_t point, float* descriptor) {
    return describe(support, point, descriptor) >= params.min_neighbours;
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_nd_histogram", describe_nd_histogram,
    "NDHist: distance against the angle between normals (128 numbers).", 1);

}  // namespace
}  // namespace posevote::describe
