// SPDX-License-Identifier: BSD-3-Clause
// The outline of a model's surfaces: places beside them, in their tangent plane, where the model is
// no more. Where a posed model ends, the scan's surface must end, too; of a carton that was fitted
// by its narrow side to a broad one, or of a body sunk into a table, the scan goes on.
#pragma once

#include "nodes/data/model.hpp"

namespace posevote {

class ModelRim {
 public:
  static constexpr int kDirections = 6;  ///< around a point, in its tangent plane

  /// Keeps references to both. The outline is of this cloud.
  ModelRim(const Cloud& model, const Outline& outline) : model_(model), outline_(outline) {}

  /// Calls visit(place) for the places ahead of point `i` where the model is no more, in the
  /// model's frame.
  template <class Visit>
  void for_each_end(Eigen::Index i, const Visit& visit) const {
    const std::uint8_t ends = outline_.ends[static_cast<std::size_t>(i)];
    for (int k = 0; k < kDirections && ends != 0; ++k)
      if ((ends >> k & 1U) != 0) visit(ahead(model_, i, k, outline_.reach));
  }

  /// The place `reach` [m] ahead of point `i` of a cloud in one of the directions.
  static Eigen::Vector3f ahead(const Cloud& cloud, Eigen::Index i, int direction, float reach);

 private:
  const Cloud& model_;
  const Outline& outline_;
};

/// Looks from every model point `reach` [m] ahead in each direction: the model goes on if any point
/// of it lies within half of that. One search a point and direction.
Outline outline_of(const Cloud& model, float reach);

}  // namespace posevote
