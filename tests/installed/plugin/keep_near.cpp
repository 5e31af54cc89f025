// SPDX-License-Identifier: BSD-3-Clause
// A node from outside: keeps what lies within a distance of the sensor.
//
//   keep_near: {into: raw_scan, distance: 2}
#include <stdexcept>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/cloud.hpp"
#include "nodes/geometry/select_rows.hpp"

namespace {

using namespace posevote;

struct Params {
  double distance = 2;
};

Scan keep_near(const Scan& scan, const Params& params) {
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const Eigen::Vector3f at = scan.points.row(i).transpose();
    if (static_cast<double>((at - scan.view.origin).norm()) <= params.distance) near.push_back(i);
  }
  if (near.empty()) throw std::runtime_error("no point of the scan is that near");
  return geometry::select_rows(scan, near);
}

const auto registered =
    graph::register_node("keep_near", keep_near, "The part of a scan that is near the sensor.")
        .input("scan")
        .output("near_scan")
        .param("distance", &Params::distance, "m", "What is farther away is left out.",
               graph::greater_than(0));

}  // namespace
