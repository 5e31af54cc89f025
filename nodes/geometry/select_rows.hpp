// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/cloud.hpp"

namespace posevote::geometry {

/// Those points of a cloud with their normals, in the order of `rows`; the view stays. `rows`: a
/// vector of row numbers or an Eigen::seq.
template <class Rows>
Cloud select_rows(const Cloud& cloud, const Rows& rows) {
  return {cloud.points(rows, Eigen::all), cloud.normals(rows, Eigen::all), cloud.view};
}

}  // namespace posevote::geometry
