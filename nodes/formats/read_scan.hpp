// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "nodes/data/cloud.hpp"

namespace posevote::formats {

/// Reads a point cloud or mesh; the ending says how, see format.hpp. Points that are NaN or
/// infinite are left out, with the faces that use them; normals are made unit length, (0, 0, 0)
/// where they have no direction. Throws std::runtime_error that says what is wrong and where, but
/// does not repeat the path.
Scan read_scan(const std::filesystem::path& path, double metres_per_unit);

/// The same without where a sensor stood: of a model.
Mesh read_mesh(const std::filesystem::path& path, double metres_per_unit);

}  // namespace posevote::formats
