// SPDX-License-Identifier: BSD-3-Clause
// Where a model's surfaces end, and bend: segmentation holds that against where the scan's do
// (outline.hpp). `reach` is what a scan that ends is off at most: sensors that match by windows let
// what stands in front run up to five pixels over its edge, and the tolerance comes to that.
//
// A closed body ends where it turns away. Where an open mesh has its border, the body may well go
// on: a scan without its bottom, a CAD model of some faces of a thing. So nothing is said there,
// unless `borders: end` says that the model is whole, a sheet. O(points + faces log faces).
//
//   find_outline: {in: [model_meshes, model_clouds, scale], out: outlines}
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/outline.hpp"
#include "nodes/geometry/winding.hpp"

namespace posevote::train {
namespace {

struct Params {
  double reach = 9, gap_reach = 4, bend_reach = 1.5;
  std::string borders = "unknown";
};

/// Points along the edges that one face has alone, at most `step` [m] apart.
PointMatrix border_of(const Mesh& mesh, float step) {
  std::vector<Eigen::RowVector3f> border;
  for (const auto& [from, to] : geometry::wind_parts(mesh.points, mesh.faces).open_edges) {
    const Eigen::RowVector3f a = mesh.points.row(from), b = mesh.points.row(to);
    const float steps = std::max(1.0F, std::ceil((b - a).norm() / step));
    for (float i = 0; i <= steps; ++i) border.emplace_back(a + i / steps * (b - a));
  }
  PointMatrix points(static_cast<Eigen::Index>(border.size()), 3);
  for (std::size_t i = 0; i < border.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = border[i];
  return points;
}

/// Takes out the ends on whose way there is a border: half way, as ends lie beyond that.
void leave_out(const PointMatrix& border, const Cloud& cloud, float reach,
               std::vector<std::uint8_t>& ends) {
  const float near = reach / 2;
  const geometry::PointGrid grid(border, near);
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (int k = 0; k < geometry::kOutlineDirections && ends[i] != 0; ++k) {
      bool is_border = false;
      grid.for_each_within(geometry::place_ahead(cloud, static_cast<Eigen::Index>(i), k, near),
                           near, [&](std::uint32_t, float) { is_border = true; });
      if (is_border) ends[i] = static_cast<std::uint8_t>(ends[i] & ~(1U << k));
    }
}

Outline find_outline(const Mesh& mesh, const Cloud& cloud, const Scale& scale,
                     const Params& params) {
  geometry::require_normals(cloud);
  const auto length = [&](double in_resolutions) {
    return static_cast<float>(in_resolutions) * scale.resolution;
  };
  Outline outline = geometry::outline_of(cloud, length(params.reach), length(params.gap_reach),
                                         length(params.bend_reach));
  if (params.borders == "end" || mesh.faces.rows() == 0) return outline;
  const PointMatrix border = border_of(mesh, outline.gap_reach / 4);
  if (border.rows() == 0) return outline;
  leave_out(border, cloud, outline.reach, outline.ends);
  leave_out(border, cloud, outline.gap_reach, outline.gaps);
  return outline;
}

const auto registered =
    graph::register_node("find_outline", find_outline, "Where a model's surfaces end.")
        .input("mesh")
        .input("cloud")
        .input("scale")
        .output("outline")
        .param("reach", &Params::reach, "x resolution",
               "The model goes on where a point of it lies within half of that, that far ahead.",
               graph::greater_than(0))
        .param("gap_reach", &Params::gap_reach, "x resolution",
               "The same for holes, slots and teeth. Twice segment_objects.inlier_distance: what "
               "ends there has nothing within it.",
               graph::greater_than(0))
        .param("bend_reach", &Params::bend_reach, "x resolution",
               "So near to another face the scan's normals may be those of neither: "
               "segment_objects.bends_forgiven. 0: no bends are looked for.",
               graph::at_least(0))
        .param("borders", &Params::borders, "", "Whether the body ends where an open mesh does.",
               graph::one_of({"unknown", "end"}));

}  // namespace
}  // namespace posevote::train
