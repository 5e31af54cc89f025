// SPDX-License-Identifier: BSD-3-Clause
// Outward normals of an object model (paper, section 4, "Preprocessing").
//
// A mesh: area-weighted from its faces, wound outward (winding.hpp); the file's own normals are not
// trusted. A raw cloud: planes through the neighbours (plane_normals.hpp), signs by a traversal
// from the outermost point (orient_outward.hpp). Points without a normal (in no face, alone, on a
// line) are dropped and counted; faces are left behind. O(n log n). Fails where no point is left.
// On noisy meshes the faces' normals are useless: `source: pca` takes the neighbourhoods there,
// too.
//
//   model_normals: {in: [model_meshes, scale], out: oriented_models, radius: 3, source: auto}
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/plane_normals.hpp"
#include "nodes/geometry/winding.hpp"
#include "nodes/train/orient_outward.hpp"

namespace posevote::train {
namespace {

struct Params {
  std::string source = "auto";
  double radius = 3;
  int min_neighbours = 5;
};

constexpr float kSpacings = 3;  ///< fewest of the points' own distances in a radius

Cloud model_normals(const Cloud& mesh, const Scale& scale, const Params& params) {
  if (params.source == "faces" || (params.source == "auto" && mesh.faces.rows() > 0))
    return geometry::keep_oriented(
        mesh, geometry::face_normals(mesh.points, geometry::wind_outward(mesh.points, mesh.faces)));
  const float smallest = static_cast<float>(params.radius) * scale.resolution;
  const auto planes = geometry::suitable_planes(mesh.points, smallest, kSpacings);
  PointMatrix normals = PointMatrix::Zero(mesh.points.rows(), 3);
  if (planes) {
    normals = planes->normals(params.min_neighbours);
    orient_outward(mesh.points, planes->radius(), normals);
  }
  return geometry::keep_oriented(mesh, normals);
}

const auto registered =
    graph::register_node("model_normals", model_normals, "Outward normals of an object model.")
        .input("model")
        .input("scale")
        .output("model")
        .param(
            "source", &Params::source, "",
            "Where normals come from; auto: faces where there are any, else neighbourhoods (pca).",
            graph::one_of({"auto", "faces", "pca"}))
        .param(
            "radius", &Params::radius, "x resolution",
            "Smallest neighbourhood of a point (pca). It spans at least three of the points' own "
            "spacings, and more where the points are noisy.",
            graph::greater_than(0))
        .param("min_neighbours", &Params::min_neighbours, "",
               "Fewer points in a neighbourhood give no normal (pca).", graph::in_range(3, 1000));

}  // namespace
}  // namespace posevote::train
