// SPDX-License-Identifier: BSD-3-Clause
// Where a model's surfaces end: segmentation holds that against where the scan's do
// (outline.hpp). `reach` is what a scan that ends is off at most. O(points).
//
//   find_outline: {in: [cloud, scale], out: outline}
#include "graph/registry.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/outline.hpp"

namespace posevote::train {
namespace {

struct Params {
  double reach = 5;
};

Outline find_outline(const Cloud& cloud, const Scale& scale, const Params& params) {
  geometry::require_normals(cloud);
  return geometry::outline_of(cloud, static_cast<float>(params.reach) * scale.resolution);
}

const auto registered =
    graph::register_node("find_outline", find_outline, "Where a model's surfaces end.")
        .input("cloud")
        .input("scale")
        .output("outline")
        .param("reach", &Params::reach, "x resolution",
               "The model goes on where a point of it lies within half of that, that far ahead.",
               graph::greater_than(0));

}  // namespace
}  // namespace posevote::train
