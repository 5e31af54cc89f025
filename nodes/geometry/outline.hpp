// SPDX-License-Identifier: BSD-3-Clause
// The outline of a model's surfaces: places beside them, in their tangent plane, where the model is
// no more. Where a posed model ends, the scan's surface must end, too; of a carton that was fitted
// by its narrow side to a broad one, or of a body sunk into a table, the scan goes on.
#pragma once

#include "nodes/data/model.hpp"

namespace posevote::geometry {

constexpr int kOutlineDirections = 6;  ///< around a point, in its tangent plane

/// The place `reach` [m] ahead of point `i` of a cloud in one of the directions.
Eigen::Vector3f place_ahead(const Cloud& cloud, Eigen::Index i, int direction, float reach);

/// Calls visit(place) for the places ahead of point `i` where the model is no more, in the model's
/// frame.
template <class Visit>
void for_each_end(const Cloud& model, const Outline& outline, Eigen::Index i, const Visit& visit) {
  const std::uint8_t ends = outline.ends[static_cast<std::size_t>(i)];
  for (int k = 0; k < kOutlineDirections && ends != 0; ++k)
    if ((ends >> k & 1U) != 0) visit(place_ahead(model, i, k, outline.reach));
}

/// Looks from every model point `reach` [m] ahead in each direction: the model goes on if any point
/// of it lies within half of that. One search a point and direction.
Outline outline_of(const Cloud& model, float reach);

}  // namespace posevote::geometry
