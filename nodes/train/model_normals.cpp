// SPDX-License-Identifier: BSD-3-Clause
// Outward normals of an object model (paper, section 4, "Preprocessing").
//
// How they are found: outward_normals.hpp. The file's own normals are not trusted. Points without a
// normal (in no face, alone, on a line) are left out, and so are faces. O(n log n). Fails where no
// point is left. On noisy meshes the faces' normals are useless: `source: pca` takes the
// neighbourhoods there, too.
//
//   model_normals: {in: [model_meshes, scale], out: oriented_models, radius: 3, source: auto}
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/outward_normals.hpp"

namespace posevote::train {
namespace {

struct Params {
  std::string source = "auto";
  double radius = 3;
  int min_neighbours = 5;
};

Cloud model_normals(const Mesh& mesh, const Scale& scale, const Params& params) {
  const float smallest = static_cast<float>(params.radius) * scale.resolution;
  return geometry::keep_oriented(
      mesh.points,
      geometry::outward_normals(mesh, {params.source, smallest, params.min_neighbours}));
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
