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
// Left out are feature points without a usable normal or with fewer than `min_neighbours` such
// neighbours. Fails if none is left. Time: O(feature points x neighbours).
//
//   describe_point_pairs: {in: [cloud, points, scale], out: features, radius: 25}
#include "nodes/describe/feature_set.hpp"
#include "nodes/describe/point_pair_histogram.hpp"
#include "nodes/describe/register_descriptor.hpp"

namespace posevote {
namespace {

struct Params {
  double radius = 25;
  double min_facing = 0.2;
  int min_neighbours = 10;
};

/// Writes the descriptor of one point and returns how many neighbours it is made of.
int describe(const Support& support, std::uint32_t point, float min_facing, float* descriptor) {
  const Cloud& cloud = support.cloud();
  const Eigen::Vector3f center = cloud.points.row(point);
  const Eigen::Vector3f normal = cloud.normals.row(point);
  PointPairHistogram histogram(normal, support.radius());
  int count = 0;
  const auto add = [&](std::uint32_t neighbour, float squared) {
    if (!(squared > 0) || !is_oriented(cloud, neighbour)) return;
    const Eigen::Vector3f other = cloud.normals.row(neighbour);
    if (!(normal.dot(other) >= min_facing)) return;
    histogram.add(cloud.points.row(neighbour).transpose() - center, other);
    ++count;
  };
  support.grid().for_each_within(center, support.radius(), add);
  histogram.write(descriptor);
  return count;
}

FeatureSet describe_point_pairs(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                                const Params& params) {
  const Support support(cloud, points, scale, params.radius);
  const auto min_facing = static_cast<float>(params.min_facing);
  const auto one = [&](std::uint32_t point, float* descriptor) {
    return describe(support, point, min_facing, descriptor) >= params.min_neighbours;
  };
  return support.describe_each(PointPairHistogram::kLength, one);
}

const auto registered =
    register_descriptor<Params>(
        "describe_point_pairs", describe_point_pairs,
        "Point-pair histograms: distance against four angles (240 numbers).", 1)
        .param("min_facing", &Params::min_facing, "cosine",
               "Least n . n' of a neighbour; -1 takes all.", graph::in_range(-1, 1));

}  // namespace
}  // namespace posevote
