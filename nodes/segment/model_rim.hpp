// SPDX-License-Identifier: BSD-3-Clause
// The outline of a model's surfaces: places beside them, in their tangent plane, where the model is
// no more. Where a posed model ends, the scan's surface must end, too; of a carton that was fitted
// by its narrow side to a broad one, or of a body sunk into a table, the scan goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

class ModelRim {
 public:
  static constexpr int kDirections = 6;  ///< around a point, in its tangent plane

  /// Looks from every model point `reach` [m] ahead in each direction: the model goes on if any
  /// point of it lies within half of that. One search a point and direction.
  ModelRim(const Cloud& model, float reach);

  /// Calls visit(place) for the places ahead of point `i` where the model is no more, in the
  /// model's frame.
  template <class Visit>
  void for_each_end(Eigen::Index i, const Visit& visit) const {
    const std::uint8_t ends = ends_[static_cast<std::size_t>(i)];
    for (int k = 0; k < kDirections && ends != 0; ++k)
      if ((ends >> k & 1U) != 0) visit(ahead(i, k));
  }

 private:
  Eigen::Vector3f ahead(Eigen::Index i, int direction) const;

  const Cloud& model_;
  float reach_;
  std::vector<std::uint8_t> ends_;  // a bit for each direction, per point
};

}  // namespace posevote
