// SPDX-License-Identifier: BSD-3-Clause
// Spin images (Johnson, Hebert, PAMI 1999; PCL's code): how the surface is spread over distance
// from the normal's line and height over the tangent plane, within a cylinder. 9 x 17 = 153
// numbers of sum 1, shared linearly between neighbouring bins.
//
// Neighbours whose normal is turned away by more than an angle do not count, as Johnson proposes
// against clutter and self-occlusion; PCL tells a normal from its opposite in this one place not.
// The cylinder is inscribed in the sphere of `radius`. The authors of rotational subgroup voting
// used 17.5 mean edges of their meshes; on UWA's models one of those is some 1.27 of our
// resolutions.
//
// Left out are feature points without a usable normal or with fewer than `min_neighbours`
// neighbours, or with none in the cylinder. Time: O(feature points x
// neighbours).
//
//   describe_spin_images: {in: [cloud, points, scale], out: features, radius: 22}
#include <pcl/features/spin_image.h>

#include "nodes/adapters/pcl_surface.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 22;
  double min_facing = 0.5;
  int min_neighbours = 10;
};

constexpr int kWidth = 8;
constexpr int kLength = (kWidth + 1) * (2 * kWidth + 1);

FeatureSet describe_spin_images(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                                const Params& params) {
  using Image = pcl::Histogram<kLength>;
  const adapters::PclSupport support(cloud, points, scale, params.radius, params.min_neighbours);
  return support.describe(kLength, 64, [&](const adapters::PclRows& rows, DescriptorMatrix& out) {
    pcl::SpinImageEstimation<pcl::PointXYZ, pcl::Normal, Image> estimation(kWidth,
                                                                           params.min_facing);
    estimation.setInputNormals(support.surface().normals);
    adapters::run_estimation<Image>(
        estimation, support, rows, [](const Image& image) { return image.histogram; }, out);
  });
}

const auto registered =
    descriptors::register_descriptor<Params>(
        "describe_spin_images", describe_spin_images,
        "Spin images: distance from the normal against height (153 numbers).", 1)
        .param("min_facing", &Params::min_facing, "cosine",
               "Least |n . n'| of a neighbour; 0 takes all.", graph::in_range(0, 1));

}  // namespace
}  // namespace posevote::describe
