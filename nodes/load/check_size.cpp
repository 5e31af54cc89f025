// SPDX-License-Identifier: BSD-3-Clause
// Passes a scan on if its size and the models' can fit, and refuses it if not: metres read as
// millimetres, or the reverse, would find nothing and say nothing. The message names the unit that
// would fit, of the scan where the models' sizes are those of usual objects, else of the models.
//
// The limits lie between what is real and a unit's factor of 1000: a scan of one object, half
// occluded, is about half a model's size; an RGB-D view of 10 m with objects of 5 cm is 200 times a
// model's. A large scan must also be dense enough to show a model at all. The scan's size leaves
// out the outermost share of the points along each axis, so single stray points change nothing.
// Linear in the points.
//
//   check_size: {in: [raw_scan, library], out: scan}
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/geometry/extent.hpp"

namespace posevote::load {
namespace {

struct Params {
  double smallest = 0.2;
  double largest = 400;
  double outliers = 0.02;
};

std::string check(const Params& params) {
  return params.smallest < params.largest ? "" : "smallest must be less than largest";
}

/// Whether cubes of that edge [m] that hold any point hold fewer than two on average: the points are
/// farther apart than that. Ends early where they are not.
bool is_sparse(const PointMatrix& points, double edge) {
  constexpr double kMost = 1 << 20;  // cubes on either side of the origin; strays share the last
  std::unordered_set<std::uint64_t> cubes;
  Eigen::Index sharing = 0;
  std::uint64_t before = ~std::uint64_t{0};
  for (Eigen::Index i = 0; i < points.rows() && 2 * sharing < points.rows(); ++i) {
    std::uint64_t cube = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double at = std::clamp(points(i, axis) / edge + kMost, 0.0, 2 * kMost - 1);
      cube = (cube << 21) | static_cast<std::uint64_t>(at);
    }
    const bool is_shared = cube == before || !cubes.insert(cube).second;  // neighbours in a row
    sharing += is_shared ? 1 : 0;
    before = cube;
  }
  return 2 * sharing < points.rows();
}

/// Diagonals of the models [m].
struct Sizes {
  double smallest = 0, largest = 0;
};

Sizes sizes_of(const ModelLibrary& library) {
  const auto smaller = [](const auto& a, const auto& b) { return a->diagonal < b->diagonal; };
  const auto [least, most] =
      std::minmax_element(library.models.begin(), library.models.end(), smaller);
  return {static_cast<double>((*least)->diagonal), static_cast<double>((*most)->diagonal)};
}

/// What the user could say to make them fit.
std::string advice(const Scan& scan, double size, const Sizes& models, const Params& params) {
  constexpr double kUsual[] = {0.001, 20};  // [m]; of models
  constexpr double kMost = 100;             // x largest model; of scans that people take
  if (models.smallest >= kUsual[0] && models.largest <= kUsual[1]) {
    if (scan.view.pixels.x() > 0)
      return "check depth_scale, of the data set's cameras or load_scene.depth_scale";
    const auto wrong =
        formats::unit_mistake(size, params.smallest * models.smallest, kMost * models.largest);
    if (wrong)
      return "is the scan in " + wrong->is + ", but read as " + wrong->read_as +
             "? Say --scene-unit " + wrong->is + " (load_scene.unit)";
  } else if (const auto wrong =
                 formats::unit_mistake(models.largest, size / kMost, size / params.smallest)) {
    return "are the models in " + wrong->is + ", but read as " + wrong->read_as +
           "? Say --model-unit " + wrong->is + " (load_models.unit)";
  }
  return "check --scene-unit (load_scene.unit; of images, depth_scale) and --model-unit "
         "(load_models.unit)";
}

/// Evenly taken; enough to tell a size.
PointMatrix some_of(const PointMatrix& points) {
  constexpr Eigen::Index kEnough = 20000;
  return points(Eigen::seq(0, Eigen::last, points.rows() / kEnough + 1), Eigen::all);
}

using ScanPointer = std::shared_ptr<const Scan>;

ScanPointer check_size(const ScanPointer& scan, const ModelLibrary& library, const Params& params) {
  if (scan->points.rows() == 0) throw std::runtime_error("the scan has no points");
  if (library.models.empty()) throw std::runtime_error("the model library is empty");
  const Sizes models = sizes_of(library);
  const double size = geometry::robust_diagonal(some_of(scan->points), params.outliers);
  const bool fits =
      size >= params.smallest * models.smallest && size <= params.largest * models.largest;
  const bool sparse = size > models.largest && is_sparse(scan->points, models.largest);
  if (fits && !sparse) return scan;
  throw std::runtime_error("the scan's diagonal is " + formats::in_metres(size) + ", the models' " +
                           formats::in_metres(models.smallest) + " to " +
                           formats::in_metres(models.largest) +
                           (sparse ? ", less than from point to point of the scan: " : ": ") +
                           advice(*scan, size, models, params));
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
