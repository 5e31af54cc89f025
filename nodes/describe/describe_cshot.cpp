// SPDX-License-Identifier: BSD-3-Clause
// CSHOT (Tombari, Salti, Di Stefano: A combined texture-shape descriptor for enhanced 3D feature
// matching, ICIP 2011; PCL's code): SHOT's 352 numbers of normals, and 992 more that count, over the
// same cells, by how much the colours differ from the feature point's (CIELAB). 1344 numbers.
//
// A cloud without colours is described as one of one colour. Left out are feature points without a
// usable normal, with fewer than `min_neighbours` neighbours, or for which PCL finds no frame. Time:
// O(feature points x neighbours).
//
//   describe_cshot: {in: [cloud, points, scale], out: features, radius: 20}
#include <pcl/features/shot.h>

#include <algorithm>
#include <memory>

#include "nodes/adapters/pcl_surface.hpp"
#include "nodes/color/srgb.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 20;
  int min_neighbours = 10;
};

constexpr int kLength = 1344;

using Colored = pcl::PointXYZRGB;

/// PCL 1.13 looks white up one beyond the end of its table.
std::uint8_t byte_of(float linear) { return std::min<std::uint8_t>(color::byte_of(linear), 254); }

/// The surface's points with the cloud's colours.
std::shared_ptr<pcl::PointCloud<Colored>> colored(const adapters::PclSurface& surface,
                                                  const Cloud& cloud) {
  auto points = std::make_shared<pcl::PointCloud<Colored>>();
  points->resize(surface.points->size());
  for (std::size_t i = 0; i < surface.row_of.size(); ++i) {
    if (surface.row_of[i] < 0) continue;
    const auto row = static_cast<std::size_t>(surface.row_of[i]);
    Colored& point = (*points)[row];
    point.getVector3fMap() = (*surface.points)[row].getVector3fMap();
    if (cloud.colors.rows() == 0) continue;
    const auto color = cloud.colors.row(static_cast<Eigen::Index>(i));
    point.r = byte_of(color[0]);
    point.g = byte_of(color[1]);
    point.b = byte_of(color[2]);
  }
  return points;
}

FeatureSet describe_cshot(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                          const Params& params) {
  adapters::PclSupport support(cloud, points, scale, params.radius, params.min_neighbours);
  support.find_frames();
  const std::shared_ptr<pcl::PointCloud<Colored>> surface = colored(support.surface(), cloud);
  const auto tree = adapters::shared_tree<Colored>(surface);
  return support.describe(kLength, 64, [&](const adapters::PclRows& rows, DescriptorMatrix& out) {
    pcl::SHOTColorEstimation<Colored, pcl::Normal> estimation;
    estimation.setInputNormals(support.surface().normals);
    estimation.setInputReferenceFrames(support.frames(rows));
    adapters::run_estimation<pcl::SHOT1344>(
        estimation, surface, tree, support.radius(), rows,
        [](const pcl::SHOT1344& shot) { return shot.descriptor; }, out);
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_cshot", describe_cshot,
    "CSHOT: histograms of normals and colours in a local frame (1344 numbers).", 5);

}  // namespace
}  // namespace posevote::describe
