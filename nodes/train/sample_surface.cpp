// SPDX-License-Identifier: BSD-3-Clause
// An object model as oriented points, evenly spread over its surface, normals outward (paper,
// section 4, "Preprocessing").
//
// A mesh is sampled on its faces, so that a box of twelve triangles is as good a model as a scan of
// it (face_samples.hpp). Before that, copies of faces and faces without extent are left out and
// the windings made to agree (winding.hpp); after it, rays find out which side of a part is its
// outside, which parts are sheets that have two, and what lies within the body where nobody can see
// it (seen_sides.hpp). A raw cloud keeps its points and gets the normals of their neighbourhoods
// (outward_normals.hpp). The file's own normals are not trusted. Points without a normal (alone, on
// a line) are left out. Fails where no point is left.
//
// Where the mesh has colours, by point or by texture, each sample has that of its place.
//
// On noisy meshes the faces' normals are useless: `source: pca` takes the vertices as a raw cloud.
// `spacing: 0` takes the vertices, too, with normals of their faces. A model so large that it
// would need more than `max_points` is sampled that much more coarsely. O(n log n).
//
//   sample_surface: {in: [octave_meshes, octaves], out: model_surfaces, spacing: 0.3}
#include <numbers>
#include <string>

#include "graph/registry.hpp"
#include "nodes/color/texture_color.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/outward_normals.hpp"
#include "nodes/train/seen_sides.hpp"

namespace posevote::train {
namespace {

struct Params {
  std::string source = "auto";
  double spacing = 0.3;
  double crease = 30;
  int max_points = 2000000;
  double radius = 3;
  int min_neighbours = 5;
  Visibility visibility;
};

ColorMatrix colors_of(const Mesh& mesh, const FaceMatrix& faces,
                      const geometry::FaceSamples& samples) {
  if (!color::is_colored(mesh)) return {};
  ColorMatrix colors(samples.points.rows(), 3);
  for (Eigen::Index i = 0; i < colors.rows(); ++i)
    colors.row(i) = color::face_color(mesh, faces.row(samples.faces[static_cast<std::size_t>(i)]),
                                      samples.weights.row(i));
  return colors;
}

Cloud sample_surface(const Mesh& mesh, const Scale& scale, const Params& params) {
  const bool by_faces =
      params.source == "faces" || (params.source == "auto" && mesh.faces.rows() > 0);
  if (!by_faces || params.spacing == 0) {
    const float smallest = static_cast<float>(params.radius) * scale.resolution;
    return geometry::keep_oriented(
        mesh.points,
        geometry::outward_normals(mesh, {params.source, smallest, params.min_neighbours}), {},
        color::point_colors(mesh));
  }
  const geometry::WoundFaces wound = geometry::wind_parts(mesh.points, mesh.faces);
  const geometry::FaceSamples samples = geometry::sample_faces(
      mesh.points, wound.faces, params.spacing * scale.resolution,
      params.crease * std::numbers::pi / 180, static_cast<std::size_t>(params.max_points));
  return keep_seen(mesh.points, wound, samples, colors_of(mesh, wound.faces, samples),
                   params.visibility);
}

const auto registered =
    graph::register_node("sample_surface", sample_surface,
                         "An object model as points evenly spread over its faces, normals outward.")
        .input("model")
        .input("scale")
        .output("surface")
        .param("source", &Params::source, "",
               "What a model is made of; auto: faces where there are any, else points and their "
               "neighbourhoods (pca).",
               graph::one_of({"auto", "faces", "pca"}))
        .param("spacing", &Params::spacing, "x resolution",
               "Distance between samples of a mesh; 0 takes its vertices instead.",
               graph::in_range(0, 10))
        .param(
            "two_sided", [](Params& params) -> auto& { return params.visibility.two_sided; }, "",
            "Whether faces have two sides; auto: those of parts that are as open to the back, "
            "as a sheet is.",
            graph::one_of({"auto", "always", "never"}))
        .param(
            "hidden", [](Params& params) -> auto& { return params.visibility.hidden; }, "",
            "Keep what lies within the body, too.")
        .param("max_points", &Params::max_points, "",
               "More samples of a mesh than this widen the spacing.",
               graph::in_range(1000, 100000000))
        .param(
            "radius", &Params::radius, "x resolution",
            "Smallest neighbourhood of a point (pca). It spans at least three of the points' own "
            "spacings, and more where the points are noisy.",
            graph::greater_than(0))
        .param("min_neighbours", &Params::min_neighbours, "",
               "Fewer points in a neighbourhood give no normal (pca).", graph::in_range(3, 1000))
        .expert_param("crease", &Params::crease, "deg",
                      "Faces at a corner that differ by less are one smooth surface; 0: none.",
                      graph::in_range(0, 180))
        .expert_param(
            "as_open", [](Params& params) -> auto& { return params.visibility.as_open; }, "",
            "Two-sided is a part whose one side sees this share of what the other side sees of the "
            "outside. A body without its bottom has some 0.2, half of a hollow ball 0.5.",
            graph::in_range(0, 1));

}  // namespace
}  // namespace posevote::train
