// SPDX-License-Identifier: BSD-3-Clause
// Normals of a scan, toward the sensor (paper, section 4, "Preprocessing"). They carry the whole
// method: a vote lands where two normals say.
//
// Each point takes the first that gives it one: the file's own normal, its faces (area-weighted),
// the plane through its neighbours. Faces that stand 15 deg off the planes at half of the points
// are those of a noisy mesh and not believed: on the Bunny with 0.5 % noise they are 20 deg off the
// truth, the planes 6 deg. The neighbourhood spans at least six of the scan's own spacings (best
// on RGB-D at 0.4 to 1 m: 5 to 15 mm) and widens with the noise (plane_normals.hpp; for depth
// images image_normals.hpp).
//
// With `outward`, the scan is the whole surface of a body, as a model is: its normals are made as
// sample_surface makes them (outward_normals.hpp), and no sensor says where they point.
//
// Points without a normal (alone, on a line) are left out, and so are faces. O(n log n), parallel.
// Fails where no point is left.
//
//   estimate_normals: {in: [scan, scale], out: oriented_scan, radius: 3, source: auto}
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/outward_normals.hpp"
#include "nodes/geometry/plane_normals.hpp"
#include "nodes/prepare/image_normals.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  std::string source = "auto";
  double radius = 3;
  int min_neighbours = 5;
  bool outward = false;
};

std::string check(const Params& params) {
  return params.outward && params.source == "file"
             ? "outward normals are not the file's: source must be auto, faces or pca"
             : "";
}

constexpr float kSpacings = 6;  ///< fewest of the points' own distances in a radius

/// Fills the rows that are still zero; all if there are none.
void fill(PointMatrix& normals, PointMatrix with) {
  if (with.rows() == 0) return;
  if (normals.rows() == 0) {
    normals = std::move(with);
    return;
  }
  graph::parallel_for(static_cast<std::size_t>(normals.rows()), 8192, [&](std::size_t row) {
    const auto i = static_cast<Eigen::Index>(row);
    if (normals.row(i).isZero()) normals.row(i) = with.row(i);
  });
}

/// Whether most of the normals roughly agree with the planes, if there are any.
bool agree(const PointMatrix& normals, const PointMatrix& planes) {
  std::ptrdiff_t both = 0;
  std::ptrdiff_t close = 0;
  for (Eigen::Index i = 0; i < planes.rows(); ++i) {
    if (normals.row(i).isZero() || planes.row(i).isZero()) continue;
    ++both;
    if (std::abs(normals.row(i).dot(planes.row(i))) > 0.966F) ++close;  // cos 15 deg
  }
  return 2 * close >= both;
}

PointMatrix file_normals(const Scan& scan) {
  if (scan.normals.rows() != scan.points.rows())
    throw std::runtime_error("it has " + std::to_string(scan.normals.rows()) + " normals for " +
                             std::to_string(scan.points.rows()) + " points");
  PointMatrix normals = scan.normals;
  geometry::normalise(normals);
  return normals;
}

PointMatrix neighbour_planes(const Scan& scan, float smallest, const Params& params) {
  if (auto normals = image_normals(scan, smallest, kSpacings, params.min_neighbours))
    return *std::move(normals);
  const auto planes = geometry::suitable_planes(scan.points, smallest, kSpacings);
  return planes ? planes->normals(params.min_neighbours) : PointMatrix::Zero(scan.points.rows(), 3);
}

/// Whether each point has one.
bool complete(const Scan& scan, const PointMatrix& normals) {
  if (normals.rows() != scan.points.rows()) return false;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (normals.row(i).isZero()) return false;
  return true;
}

/// Toward the sensor.
PointMatrix scan_normals(const Scan& scan, float smallest, const Params& params) {
  const auto uses = [&params](const char* source) {
    return params.source == "auto" || params.source == source;
  };
  PointMatrix normals;  // none yet
  if (uses("file") && scan.normals.rows() > 0) normals = file_normals(scan);
  if (!complete(scan, normals) && (uses("faces") || uses("pca"))) {
    PointMatrix planes;
    if (uses("pca")) planes = neighbour_planes(scan, smallest, params);
    if (uses("faces") && scan.faces.rows() > 0) {
      PointMatrix by_faces = geometry::face_normals(scan.points, scan.faces);
      if (agree(by_faces, planes)) fill(normals, std::move(by_faces));
    }
    fill(normals, std::move(planes));
  }
  if (normals.rows() == 0) normals.setZero(scan.points.rows(), 3);
  geometry::turn_toward(scan.view.origin, scan.points, normals);
  return normals;
}

Cloud estimate_normals(const Scan& scan, const Scale& scale, const Params& params) {
  const float smallest = static_cast<float>(params.radius) * scale.resolution;
  PointMatrix normals = params.outward ? geometry::outward_normals(
                                             scan, {params.source, smallest, params.min_neighbours})
                                       : scan_normals(scan, smallest, params);
  return geometry::keep_oriented(scan.points, std::move(normals), scan.view, scan.colors);
}

const auto registered =
    graph::register_node("estimate_normals", estimate_normals,
                         "Normals of a scan, toward the sensor.")
        .input("scan")
        .input("scale")
        .output("scan")
        .param("source", &Params::source, "",
               "Where normals come from; auto: per point the file, else its faces unless they are "
               "noisy, else the neighbours' plane (pca).",
               graph::one_of({"auto", "file", "faces", "pca"}))
        .param("radius", &Params::radius, "x resolution",
               "Smallest neighbourhood of a point (pca). It spans at least six (outward: three) of "
               "the points' own spacings, and more where the points are noisy.",
               graph::greater_than(0))
        .param("min_neighbours", &Params::min_neighbours, "",
               "Fewer points in a neighbourhood give no normal (pca).", graph::in_range(3, 1000))
        .param("outward", &Params::outward, "",
               "The scan is a whole body: its normals point outward, not to the sensor. They are "
               "made as sample_surface makes them, the file's own are not used.")
        .check(check);

}  // namespace
}  // namespace posevote::prepare
