// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include "graph/parallel.hpp"
#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Those rows of a matrix; parallel. `rows`: a vector of row numbers or an Eigen::seq.
template <class Matrix, class Rows>
Matrix rows_of(const Matrix& matrix, const Rows& rows) {
  Matrix selected(static_cast<Eigen::Index>(rows.size()), matrix.cols());
  graph::parallel_for(static_cast<std::size_t>(rows.size()), 8192, [&](std::size_t i) {
    selected.row(static_cast<Eigen::Index>(i)) = matrix.row(static_cast<Eigen::Index>(rows[i]));
  });
  return selected;
}

/// The same of a matrix that may have none at all.
template <class Matrix, class Rows>
Matrix select_if_any(const Matrix& matrix, const Rows& rows) {
  if (matrix.rows() == 0) return {};
  return rows_of(matrix, rows);
}

/// Those points with their normals and colours, in the order of `rows`; the view stays.
template <class Rows>
Cloud select_rows(const Cloud& cloud, const Rows& rows) {
  return {rows_of(cloud.points, rows), rows_of(cloud.normals, rows), cloud.view,
          select_if_any(cloud.colors, rows)};
}

/// Those points of a Mesh or a Scan, with their normals and colours where it has any. No faces:
/// what is left of a face has no rows to name; and no texture, which belongs to faces.
template <std::derived_from<Mesh> Surface, class Rows>
Surface select_rows(const Surface& surface, const Rows& rows) {
  Surface selected;
  if constexpr (std::derived_from<Surface, Scan>) selected.view = surface.view;
  selected.points = rows_of(surface.points, rows);
  selected.normals = select_if_any(surface.normals, rows);
  selected.colors = select_if_any(surface.colors, rows);
  return selected;
}

}  // namespace posevote::geometry
