// SPDX-License-Identifier: BSD-3-Clause
// Procedural objects: closed, wound outward. Free forms, asymmetric and rich in features, and goods
// (goods.hpp). Each shape is a kind; each seed makes another individual of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"

namespace posevote {

/// Kinds of objects: "boulder", "horn", "coral" ...
const std::vector<std::string>& shape_names();

/// Whether the kind looks the same however it is turned about z.
bool is_round_shape(const std::string& shape);

/// A mesh of about 5 000 to 50 000 vertices whose bounding box is centred at the origin and `size`
/// [m] long on its longest side. Throws std::invalid_argument for an unknown shape.
Mesh make_shape(const std::string& shape, std::uint64_t seed, double size);

}  // namespace posevote
