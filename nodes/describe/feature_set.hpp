// SPDX-License-Identifier: BSD-3-Clause
// What all descriptors have in common: the check before, and the choice after.
#pragma once

#include <vector>

#include "nodes/data/features.hpp"

namespace posevote {

/// Throws std::runtime_error if the cloud has no normals, there are no feature points, one of them
/// is not in the cloud, or the scale is not positive.
void require_describable(const Cloud& cloud, const FeaturePoints& points, const Scale& scale);

/// Whether the feature point has a finite position and a unit normal, at least roughly.
bool is_oriented(const Cloud& cloud, std::uint32_t point);

/// The feature points whose descriptor could be computed, row i of `descriptors` belonging to
/// points.indices[i]. A row that is not finite is left out too. Throws std::runtime_error if
/// nothing is left.
FeatureSet keep_described(const Cloud& cloud, const FeaturePoints& points,
                          const DescriptorMatrix& descriptors, const std::vector<char>& described);

}  // namespace posevote
