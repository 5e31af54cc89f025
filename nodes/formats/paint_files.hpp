// SPDX-License-Identifier: BSD-3-Clause
// Which other files a mesh is read from: libraries of materials, and images.
#pragma once

#include <filesystem>
#include <vector>

namespace posevote::formats {

/// Those that a mesh's file names for its colours and that are there, without reading its points. Empty
/// for formats without, and where its reader will complain.
std::vector<std::filesystem::path> paint_files(const std::filesystem::path& mesh);

}  // namespace posevote::formats
