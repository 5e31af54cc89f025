// SPDX-License-Identifier: BSD-3-Clause
// USC, unique shape contexts (Tombari, Salti, Di Stefano, 3DOR 2010; PCL's code): how the surface
// is spread over the cells of a sphere around the feature point, logarithmic in the distance, in
// SHOT's local frame. 14 azimuths x 14 elevations x 10 distances = 1960 numbers.
//
// Every neighbour weighs inversely to the number of points around it and to the cube root of its
// cell's volume. As in the paper, cells begin at a tenth of the radius; points are counted within a
// fifth of it, as in PCL's own examples. The authors of rotational subgroup voting used 12.5 mean
// edges of their meshes; on UWA's models one of those is some 1.27 of our resolutions.
//
// Left out are feature points without a usable normal, with fewer than `min_neighbours` neighbours,
// or for which PCL finds no frame. Time: O(feature points x neighbours x
// their neighbours): the slowest of all, and the longest to match.
//
//   describe_usc: {in: [cloud, points, scale], out: features, radius: 16}
#include <pcl/features/usc.h>

#include <limits>

#include "nodes/adapters/pcl_surface.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 16;
  int min_neighbours = 10;
};

constexpr int kLength = 1960;

/// PCL's class, but for the outer edges of its cells. They are rounded sums and powers, which may
/// stay below the largest distance or angle; a neighbour beyond would be counted past the end of
/// the array.
class ShapeContext : public pcl::UniqueShapeContext<pcl::PointXYZ> {
 protected:
  bool initCompute() override {
    if (!UniqueShapeContext::initCompute()) return false;
    for (std::vector<float>* edges : {&radii_interval_, &theta_divisions_, &phi_divisions_})
      edges->back() = std::numeric_limits<float>::infinity();
    return true;
  }
};

FeatureSet describe_usc(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                        const Params& params) {
  adapters::PclSupport support(cloud, points, scale, params.radius, params.min_neighbours);
  support.find_frames();
  const auto radius = static_cast<double>(support.radius());
  return support.describe(kLength, 32, [&](const adapters::PclRows& rows, DescriptorMatrix& out) {
    ShapeContext estimation;
    estimation.setMinimalRadius(radius / 10);
    estimation.setPointDensityRadius(radius / 5);
    estimation.setLocalRadius(radius);
    estimation.setInputReferenceFrames(support.frames(rows));
    adapters::run_estimation<pcl::UniqueShapeContext1960>(
        estimation, support, rows,
        [](const pcl::UniqueShapeContext1960& context) { return context.descriptor; }, out);
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_usc", describe_usc, "USC: shape contexts in a local frame (1960 numbers).", 5);

}  // namespace
}  // namespace posevote::describe
