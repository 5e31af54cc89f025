// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/icp_pairs.hpp"

#include <algorithm>
#include <optional>

#include "nodes/geometry/facing_points.hpp"

namespace posevote::geometry {
namespace {

constexpr double kLeastVariance = 0.05;  // x resolution^2: no scan's planes hold better

IcpPair find_partner(const OrientedPoint& p, const ScanSurface& scan, float distance) {
  IcpPair pair;
  const std::optional<OrientedPoint> partner = scan.nearest_compatible(p, distance);
  if (!partner) return pair;
  const Eigen::Vector3f offset = p.point - partner->point;
  pair.point = p.point.cast<double>();
  pair.normal = partner->normal.cast<double>();
  pair.residual = static_cast<double>(offset.dot(partner->normal));
  pair.weight = biweight(1 - offset.squaredNorm() / (distance * distance));
  return pair;
}

}  // namespace

std::vector<IcpPair> find_icp_pairs(const Cloud& model, const ScanSurface& scan,
                                    const Eigen::Isometry3f& T_scene_model, float distance,
                                    Eigen::Index most) {
  return strewn_pairs(model, most,
                      [&](const Strewn& rows, std::size_t begin, std::size_t end, const auto& add) {
                        for_each_facing(model, rows, begin, end, T_scene_model, scan,
                                        [&](std::size_t k, const OrientedPoint& p, float) {
                                          add(k, find_partner(p, scan, distance));
                                        });
                      });
}

void weigh_beside_planes(std::vector<IcpPair>& pairs, double variance, double spread,
                         double resolution) {
  const double share =
      std::max(variance, kLeastVariance * resolution * resolution) / (spread * spread);
  for (IcpPair& pair : pairs) pair.weight *= std::min(1.0, share);
}

}  // namespace posevote::geometry
