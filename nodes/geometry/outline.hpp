// SPDX-License-Identifier: BSD-3-Clause
// The outline of a model's surfaces: places beside them, in their tangent plane, where the model is
// no more. Where a posed model ends, the scan's surface must end, too; of a carton that was fitted
// by its narrow side to a broad one, or of a body sunk into a table, the scan goes on.
#pragma once

#include <cstddef>

#include "nodes/data/model.hpp"

namespace posevote::geometry {

constexpr int kOutlineDirections = 6;  ///< around a point, in its tangent plane

/// The place `reach` [m] ahead of point `i` of a cloud in one of the directions.
Eigen::Vector3f place_ahead(const Cloud& cloud, Eigen::Index i, int direction, float reach);

/// Calls visit(place) for the places ahead of point `i` whose bits are set, in the model's frame.
template <class Visit>
void for_each_place(const Cloud& model, unsigned bits, float reach, Eigen::Index i,
                    const Visit& visit) {
  for (int k = 0; k < kOutlineDirections && bits != 0; ++k)
    if ((bits >> k & 1U) != 0) visit(place_ahead(model, i, k, reach));
}

/// Calls visit(place) for the places ahead of point `i` where the model is no more, in the model's
/// frame.
template <class Visit>
void for_each_end(const Cloud& model, const Outline& outline, Eigen::Index i, const Visit& visit) {
  for_each_place(model, outline.ends[static_cast<std::size_t>(i)], outline.reach, i, visit);
}

/// Calls visit(place, is_hole) for the gaps ahead of point `i`; behind a hole the model goes on.
template <class Visit>
void for_each_gap(const Cloud& model, const Outline& outline, Eigen::Index i, const Visit& visit) {
  const unsigned gaps = outline.gaps[static_cast<std::size_t>(i)];
  const unsigned ends = outline.ends[static_cast<std::size_t>(i)];
  for_each_place(model, gaps & ends, outline.gap_reach, i,
                 [&](const Eigen::Vector3f& place) { visit(place, false); });
  for_each_place(model, gaps & ~ends, outline.gap_reach, i,
                 [&](const Eigen::Vector3f& place) { visit(place, true); });
}

/// Looks from every model point `reach` and `gap_reach` [m] ahead in each direction: the model goes
/// on if any point of it lies within half of that. Two searches a point and direction. Within
/// `bend_reach` [m] of a bend are points of faces that turn by 45 to 135 deg; 0: not asked.
Outline outline_of(const Cloud& model, float reach, float gap_reach, float bend_reach = 0);

}  // namespace posevote::geometry
