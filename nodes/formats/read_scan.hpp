// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "nodes/data/cloud.hpp"

namespace posevote::formats {

using Warn = std::function<void(const std::string& what)>;

/// Reads a point cloud or mesh; the ending says how, see format.hpp. Points that are NaN or
/// infinite are left out, with the faces that use them; normals are made unit length, (0, 0, 0)
/// where they have no direction. Throws std::runtime_error that says what is wrong and where, but
/// does not repeat the path. Colours that the file has but that cannot be read (an image is
/// missing, say) are left out, and `warn` is told why.
Scan read_scan(const std::filesystem::path& path, double metres_per_unit, const Warn& warn = {});

/// The same without where a sensor stood, and with a texture where there is one: of a model.
Mesh read_mesh(const std::filesystem::path& path, double metres_per_unit, const Warn& warn = {});

}  // namespace posevote::formats
