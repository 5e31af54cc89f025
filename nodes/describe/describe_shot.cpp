// SPDX-License-Identifier: BSD-3-Clause
// SHOT (Tombari, Salti, Di Stefano, ECCV 2010; PCL's code): histograms of normals over the cells of
// a sphere around the feature point, in a repeatable local frame. 352 numbers.
//
// Left out are feature points without a usable normal, with fewer than `min_neighbours` neighbours,
// or for which PCL finds no frame. Time: O(feature points x neighbours).
//
//   describe_shot: {in: [cloud, points, scale], out: features, radius: 20}
#include <pcl/features/shot.h>

#include "nodes/adapters/pcl_surface.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 20;
  int min_neighbours = 10;
};

constexpr int kLength = 352;

FeatureSet describe_shot(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                         const Params& params) {
  adapters::PclSupport support(cloud, points, scale, params.radius, params.min_neighbours);
  support.find_frames();
  return support.describe(kLength, 64, [&](const adapters::PclRows& rows, DescriptorMatrix& out) {
    pcl::SHOTEstimation<pcl::PointXYZ, pcl::Normal, pcl::SHOT352> estimation;
    estimation.setInputNormals(support.surface().normals);
    estimation.setInputReferenceFrames(support.frames(rows));
    adapters::run_estimation<pcl::SHOT352>(
        estimation, support, rows, [](const pcl::SHOT352& shot) { return shot.descriptor; }, out);
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_shot", describe_shot, "SHOT: histograms of normals in a local frame (352 numbers).",
    5);

}  // namespace
}  // namespace posevote::describe
