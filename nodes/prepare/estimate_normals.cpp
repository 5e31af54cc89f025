// SPDX-License-Identifier: BSD-3-Clause
// Normals of a scan, toward the sensor (paper, section 4, "Preprocessing"; METHOD: "Normals carry
// the whole method").
//
// In order of preference: the file's own where they are usable, area-weighted from faces, else the
// plane through the neighbours within `radius`. The neighbourhood never has fewer than a few of the
// scan's own points across, so a coarse scan gets normals as well. Points without a normal (alone,
// on a line) are dropped and counted. O(n k) for k neighbours a point, parallel. Fails where no
// point is left.
//
//   estimate_normals: {in: [scan, scale], out: oriented_scan, radius: 5, source: auto}
#include <algorithm>
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/prepare/normals.hpp"

namespace posevote {
namespace {

struct Params {
  std::string source = "auto";
  double radius = 5;
  int min_neighbours = 5;
};

PointMatrix from_neighbours(const Cloud& scan, const Scale& scale, const Params& params) {
  const float radius = std::max(static_cast<float>(params.radius) * scale.resolution,
                                3 * point_spacing(scan.points));
  return plane_normals(scan.points, PointGrid(scan.points, radius), radius, params.min_neighbours);
}

Cloud estimate_normals(const Cloud& scan, const Scale& scale, const Params& params) {
  const bool any = params.source == "auto";
  PointMatrix normals;
  if (scan.normals.rows() > 0 && (any || params.source == "file")) {
    normals = scan.normals;
    normalise(normals);
  }
  if (normals.isZero() && scan.faces.rows() > 0 && (any || params.source == "faces"))
    normals = face_normals(scan.points, scan.faces);
  if (normals.isZero() && (any || params.source == "pca"))
    normals = from_neighbours(scan, scale, params);
  if (normals.rows() == 0) normals.setZero(scan.points.rows(), 3);
  turn_toward(scan.viewpoint, scan.points, normals);
  return keep_oriented(scan, normals);
}

const auto registered =
    graph::register_node("estimate_normals", estimate_normals,
                         "Normals of a scan, toward the sensor.")
        .input("scan")
        .input("scale")
        .output("scan")
        .param(
            "source", &Params::source, "",
            "Where normals come from; auto: the file, else its faces, else neighbourhoods (pca).",
            graph::one_of({"auto", "file", "faces", "pca"}))
        .param("radius", &Params::radius, "x resolution",
               "Neighbourhood of a point (pca); at least three times the points' spacing.",
               graph::greater_than(0))
        .param("min_neighbours", &Params::min_neighbours, "",
               "Fewer points in a neighbourhood give no normal (pca).", graph::in_range(3, 1000));

}  // namespace
}  // namespace posevote
