// SPDX-License-Identifier: BSD-3-Clause
// Procedural free-form objects: asymmetric, rich in features, closed, wound outward. Each shape is
// a kind; each seed makes another individual of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// Kinds of objects: "boulder", "horn", "coral" ...
const std::vector<std::string>& shape_names();

/// A mesh of about 5 000 to 20 000 vertices whose bounding box is centred at the origin and `size`
/// [m] long on its longest side. Throws std::invalid_argument for an unknown shape.
Cloud make_shape(const std::string& shape, std::uint64_t seed, double size);

}  // namespace posevote
