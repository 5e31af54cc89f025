// SPDX-License-Identifier: BSD-3-Clause
// Example of a node: keeps the part of a scan that lies in a box of the sensor's frame, say above a
// conveyor. Copied to nodes/prepare/crop_box.cpp, namespace posevote::prepare, it is a node of the
// program; its test goes to tests/nodes/prepare/crop_box_test.cpp.
//
// Normals go with their points; faces are left behind. Linear in the points. Fails where nothing is
// left.
//
//   crop_box: {in: scan, out: cropped, low: [-0.5, -0.5, 0], high: [0.5, 0.5, 1]}
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/cloud.hpp"
#include "nodes/geometry/select_rows.hpp"

namespace posevote::examples {
namespace {

struct Params {
  std::vector<double> low{-1, -1, 0}, high{1, 1, 2};
};

std::string check(const Params& params) {
  if (params.low.size() != 3 || params.high.size() != 3)
    return "low and high must have three numbers each, x, y and z";
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (params.low[axis] >= params.high[axis]) return "low must be less than high on every axis";
  return "";
}

Scan crop_box(const Scan& scan, const Params& params) {
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    bool in = true;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double x = scan.points(i, axis);
      const auto a = static_cast<std::size_t>(axis);
      in = in && x >= params.low[a] && x <= params.high[a];
    }
    if (in) inside.push_back(i);
  }
  if (inside.empty())
    throw std::runtime_error("none of the scan's " + std::to_string(scan.points.rows()) +
                             " points lies in the box");
  return geometry::select_rows(scan, inside);
}

const auto registered =
    graph::register_node("crop_box", crop_box, "The part of a scan that lies in a box.")
        .input("scan")
        .output("cropped")
        .param("low", &Params::low, "m", "The box's lowest corner, x, y, z.")
        .param("high", &Params::high, "m", "Its highest corner.")
        .check(check);

}  // namespace
}  // namespace posevote::examples
