// SPDX-License-Identifier: BSD-3-Clause
// Passes a scan on if its size and the models' can fit, and refuses it if not: metres read as
// millimetres, or the reverse, would find nothing and say nothing.
//
// The limits lie between what is real and a unit's factor of 1000: a scan of one object, half
// occluded, is about half a model's size; an RGB-D view of 10 m with objects of 5 cm is 200 times a
// model's. The scan's size leaves out the outermost share of the points along each axis, so single
// stray points change nothing. Linear in the points.
//
//   check_size: {in: [raw_scan, library], out: scan}
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"

namespace posevote::load {
namespace {

struct Params {
  double smallest = 0.1;
  double largest = 400;
  double outliers = 0.02;
};

std::string check(const Params& params) {
  return params.smallest < params.largest ? "" : "smallest must be less than largest";
}

/// Extent along one axis without a share of the points at either end [m].
double robust_extent(const PointMatrix& points, Eigen::Index axis, double outliers) {
  std::vector<float> values(points.col(axis).begin(), points.col(axis).end());
  const auto out = static_cast<std::ptrdiff_t>(outliers * static_cast<double>(values.size()));
  const auto nth = [&values](std::ptrdiff_t n) {
    std::nth_element(values.begin(), values.begin() + n, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(n)]);
  };
  return nth(std::ssize(values) - 1 - out) - nth(out);
}

double robust_diagonal(const PointMatrix& points, double outliers) {
  const Eigen::Vector3d extent(robust_extent(points, 0, outliers),
                               robust_extent(points, 1, outliers),
                               robust_extent(points, 2, outliers));
  return extent.norm();
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g m", value);
  return text;
}

using ScanPointer = std::shared_ptr<const Scan>;

ScanPointer check_size(const ScanPointer& scan, const ModelLibrary& library, const Params& params) {
  if (scan->points.rows() == 0) throw std::runtime_error("the scan has no points");
  if (library.models.empty()) throw std::runtime_error("the model library is empty");
  const auto smaller = [](const auto& a, const auto& b) { return a->diagonal < b->diagonal; };
  const auto [least, most] =
      std::minmax_element(library.models.begin(), library.models.end(), smaller);
  const auto smallest = static_cast<double>((*least)->diagonal);
  const auto largest = static_cast<double>((*most)->diagonal);
  const double size = robust_diagonal(scan->points, params.outliers);
  if (size >= params.smallest * smallest && size <= params.largest * largest) return scan;
  const std::string wrong = size > largest ? "mm read as m, or models' m read as mm"
                                           : "m read as mm, or models' mm read as m";
  throw std::runtime_error(
      "the scan's diagonal is " + metres(size) + ", the models' " + metres(smallest) + " to " +
      metres(largest) + ": check load_scene.unit (for images, depth_scale) and load_models.unit (" +
      wrong + "?)");
}

const auto registered =
    graph::register_node("check_size", check_size,
                         "Refuses a scan and models whose sizes cannot fit (mm taken for m).")
        .input("raw_scan")
        .input("library")
        .output("scan")
        .param("smallest", &Params::smallest, "x smallest model",
               "A scan with a lesser diagonal is refused.", graph::at_least(0))
        .param("largest", &Params::largest, "x largest model",
               "A scan with a greater diagonal is refused.", graph::greater_than(0))
        .param("outliers", &Params::outliers, "",
               "Share of the points left out at either end of each axis.", graph::in_range(0, 0.4))
        .check(check);

}  // namespace
}  // namespace posevote::load
