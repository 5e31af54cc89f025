// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "nodes/data/cloud.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote {

/// A mesh of the user's own [m], in its file's frame, faces wound outward. `unit`: of its lengths,
/// or "auto". Throws std::invalid_argument, with the file and the cause, where it cannot be read,
/// has no faces, or is smaller than 2 mm or larger than 5 m.
Mesh read_own_mesh(const std::string& file, const std::string& unit);

/// What training finds, so that a pose is judged like those that nobody can tell from it.
ShapeSymmetry find_symmetry(const Mesh& mesh, const std::string& name);

}  // namespace posevote
