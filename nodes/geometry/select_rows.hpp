// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Those points with their normals, in the order of `rows`; the view stays. `rows`: a vector of row
/// numbers or an Eigen::seq.
template <class Rows>
Cloud select_rows(const Cloud& cloud, const Rows& rows) {
  return {cloud.points(rows, Eigen::all), cloud.normals(rows, Eigen::all), cloud.view};
}

/// Those points of a Mesh or a Scan, with their normals where it has any. No faces: what is left of
/// a face has no rows to name.
template <std::derived_from<Mesh> Surface, class Rows>
Surface select_rows(const Surface& surface, const Rows& rows) {
  Surface selected;
  if constexpr (std::derived_from<Surface, Scan>) selected.view = surface.view;
  selected.points = surface.points(rows, Eigen::all);
  if (surface.normals.rows() > 0) selected.normals = surface.normals(rows, Eigen::all);
  return selected;
}

}  // namespace posevote::geometry
