// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/icp_pairs.hpp"

#include <optional>

#include "graph/parallel.hpp"

namespace posevote::geometry {
namespace {

constexpr double kLeastVariance = 0.05;  // x resolution^2: no scan's planes hold better

IcpPair find_partner(const OrientedPoint& p, const ScanSurface& scan, float distance) {
  IcpPair pair;
  if (!scan.faces_sensor(p)) return pair;
  const std::optional<OrientedPoint> partner = scan.nearest_compatible(p, distance);
  if (!partner) return pair;
  const Eigen::Vector3f offset = p.point - partner->point;
  const float inside = 1 - offset.squaredNorm() / (distance * distance);
  pair.point = p.point.cast<double>();
  pair.normal = partner->normal.cast<double>();
  pair.residual = static_cast<double>(offset.dot(partner->normal));
  pair.weight = static_cast<double>(inside > 0 ? inside * inside : 0);
  return pair;
}

}  // namespace

/// The model is sampled with a fixed stride: voxel order runs through space, so that is even.
std::vector<IcpPair> find_icp_pairs(const Cloud& model, const ScanSurface& scan,
                                    const Eigen::Isometry3f& T_scene_model, float distance,
                                    Eigen::Index most) {
  const Eigen::Index stride = model.points.rows() / most + 1;
  const auto samples = static_cast<std::size_t>((model.points.rows() + stride - 1) / stride);
  std::vector<IcpPair> pairs(samples);
  graph::parallel_for(samples, 256, [&](std::size_t i) {
    const Eigen::Index row = static_cast<Eigen::Index>(i) * stride;
    pairs[i] = find_partner(posed_point(model, row, T_scene_model), scan, distance);
    pairs[i].row = row;
  });
  std::erase_if(pairs, [](const IcpPair& pair) { return !(pair.weight > 0); });
  return pairs;
}

void weigh_beside_planes(std::vector<IcpPair>& pairs, double variance, double spread,
                         double resolution) {
  std::erase_if(pairs, [](const IcpPair& pair) { return !(pair.weight > 0); });
  const double share =
      std::max(variance, kLeastVariance * resolution * resolution) / (spread * spread);
  for (IcpPair& pair : pairs) pair.weight *= std::min(1.0, share);
}

}  // namespace posevote::geometry
