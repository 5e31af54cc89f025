// SPDX-License-Identifier: BSD-3-Clause
// RoPS, rotational projection statistics (Guo, Sohel, Bennamoun, Lu, Wan, IJCV 2013; PCL's code):
// the neighbourhood in its local frame is turned about each axis and projected to the three
// coordinate planes; each projection is told by four central moments and the entropy of its 5 x 5
// histogram. 3 axes x 3 angles x 3 planes x 5 = 135 numbers.
//
// The local frame is that of the surface's area, for which the paper has a mesh. A sampled cloud
// has none left, so its points are joined anew (local_triangles.hpp). The authors of rotational
// subgroup voting used 12.5 mean edges of their meshes; on UWA's models one of those is some 1.27
// of our resolutions.
//
// Left out are feature points without a usable normal, with fewer than `min_neighbours` neighbours
// or that no triangle touches. On a plane or a sphere, where no frame is
// better than another, the descriptor is as good as noise. Time: O(feature points x neighbours).
//
//   describe_rops: {in: [cloud, points, scale], out: features, radius: 16}
#include <pcl/features/rops_estimation.h>

#include "nodes/adapters/pcl_surface.hpp"
#include "nodes/describe/local_triangles.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 16;
  int min_neighbours = 10;
};

constexpr int kLength = 135;
/// Points of a voxel grid stand closer than this to the centres of the gaps between them.
constexpr float kLargestGap = 1.5F;

FeatureSet describe_rops(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                         const Params& params) {
  using Statistics = pcl::Histogram<kLength>;
  adapters::PclSupport support(cloud, points, scale, params.radius, params.min_neighbours);
  const auto corners = local_triangles(support, kLargestGap * support.resolution());
  std::vector<pcl::Vertices> triangles(corners.size());
  std::vector<char> touched(support.surface().points->size(), 0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    triangles[i].vertices.assign(corners[i].begin(), corners[i].end());
    for (const int corner : corners[i]) touched[static_cast<std::size_t>(corner)] = 1;
  }
  support.leave_out_unless(touched);
  // PCL copies and sorts all triangles anew in every chunk, so chunks are large.
  return support.describe(kLength, 512, [&](const adapters::PclRows& rows, DescriptorMatrix& out) {
    pcl::ROPSEstimation<pcl::PointXYZ, Statistics> estimation;
    estimation.setTriangles(triangles);
    estimation.setSupportRadius(support.radius());
    adapters::run_estimation<Statistics>(
        estimation, support, rows, [](const Statistics& rops) { return rops.histogram; }, out);
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_rops", describe_rops,
    "RoPS: statistics of rotated projections in a local frame (135 numbers).", 3);

}  // namespace
}  // namespace posevote::describe
