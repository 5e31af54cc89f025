// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/outward_normals.hpp"

#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/orient_outward.hpp"
#include "nodes/geometry/plane_normals.hpp"
#include "nodes/geometry/winding.hpp"

namespace posevote::geometry {
namespace {

constexpr float kSpacings = 3;  ///< fewest of the points' own distances in a radius

}  // namespace

PointMatrix outward_normals(const Mesh& body, const OutwardNormals& how) {
  if (how.source == "faces" || (how.source == "auto" && body.faces.rows() > 0))
    return face_normals(body.points, wind_outward(body.points, body.faces));
  const auto planes = suitable_planes(body.points, how.radius, kSpacings);
  if (!planes) return PointMatrix::Zero(body.points.rows(), 3);
  PointMatrix normals = planes->normals(how.min_neighbours);
  orient_outward(body.points, planes->radius(), normals);
  return normals;
}

}  // namespace posevote::geometry
