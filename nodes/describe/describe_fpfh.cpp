// SPDX-License-Identifier: BSD-3-Clause
// FPFH (Rusu, Blodow, Beetz, ICRA 2009; PCL's code): histograms of three point-pair angles around
// every surface point, averaged over the neighbours of the feature point. 33 numbers.
//
// PCL's class would search its neighbours and compute the histograms of the surface anew in every
// chunk of feature points; so both are done here, once, and PCL's two steps are called on the
// result.
//
// Left out are feature points without a usable normal or with fewer than `min_neighbours`
// neighbours. Time: O(surface points x neighbours).
//
//   describe_fpfh: {in: [cloud, points, scale], out: features, radius: 10}
#include <pcl/features/fpfh.h>

#include "graph/parallel.hpp"
#include "nodes/adapters/pcl_surface.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 10;
  int min_neighbours = 10;
};

constexpr int kBins = 11;  // per angle, as in PCL
constexpr int kLength = 3 * kBins;

using Fpfh = pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33>;

struct Neighbours {
  pcl::Indices rows;
  std::vector<float> squared;
};

/// Neighbours of a surface point, itself among them.
Neighbours find_neighbours(const adapters::PclSupport& support, int row) {
  const adapters::PclSurface& surface = support.surface();
  Neighbours found;
  support.grid().for_each_within(
      surface.points->points[static_cast<std::size_t>(row)].getVector3fMap(), support.radius(),
      [&](std::uint32_t point, float squared) {
        const int neighbour = surface.row_of[point];
        if (neighbour < 0) return;
        found.rows.push_back(neighbour);
        found.squared.push_back(squared);
      });
  return found;
}

/// Simplified histograms of every surface point, one matrix an angle.
struct Simplified {
  Eigen::MatrixXf angle[3];
};

Simplified simplified_histograms(const adapters::PclSupport& support) {
  const adapters::PclSurface& surface = support.surface();
  const auto count = static_cast<Eigen::Index>(surface.points->size());
  Simplified histograms;
  for (Eigen::MatrixXf& angle : histograms.angle) angle.setZero(count, kBins);
  graph::parallel_ranges(surface.points->size(), 256, [&](std::size_t begin, std::size_t end) {
    Fpfh fpfh;
    for (std::size_t i = begin; i < end; ++i) {
      const int row = static_cast<int>(i);
      const Neighbours near = find_neighbours(support, row);
      if (near.rows.size() < 2) continue;
      fpfh.computePointSPFHSignature(*surface.points, *surface.normals, row, row, near.rows,
                                     histograms.angle[0], histograms.angle[1], histograms.angle[2]);
    }
  });
  return histograms;
}

FeatureSet describe_fpfh(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                         const Params& params) {
  const adapters::PclSupport support(cloud, points, scale, params.radius, params.min_neighbours);
  const Simplified histograms = simplified_histograms(support);
  return support.describe(kLength, 64, [&](const adapters::PclRows& rows, DescriptorMatrix& out) {
    Fpfh fpfh;
    Eigen::VectorXf histogram(kLength);
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const Neighbours near = find_neighbours(support, (*rows)[i]);
      fpfh.weightPointSPFHSignature(histograms.angle[0], histograms.angle[1], histograms.angle[2],
                                    near.rows, near.squared, histogram);
      out.row(static_cast<Eigen::Index>(i)) = histogram.transpose();
    }
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_fpfh", describe_fpfh, "FPFH: averaged histograms of point-pair angles (33 numbers).",
    2);

}  // namespace
}  // namespace posevote::describe
