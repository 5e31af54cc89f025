// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "nodes/data/model.hpp"

namespace posevote::library {

/// Throws std::runtime_error saying what is wrong with a library that nodes could not rely on: no
/// models, ids that do not ascend, a resolution or diagonal that is no length, points that are not
/// finite or outside of the bounding box, normals that are not of unit length, counts that
/// disagree, a face or a near symmetry that names a point beyond the cloud's.
/// Descriptors and blocks are the index's business.
void check_library(const ModelLibrary& library);

}  // namespace posevote::library
