// SPDX-License-Identifier: BSD-3-Clause
// What came with this program, wherever it was put.
#pragma once

#include <filesystem>

namespace posevote {

/// The folder of the configs and pipelines that come with the program: share/posevote beside the
/// library's lib. Throws std::runtime_error that says where it was looked for.
std::filesystem::path shared_folder();

}  // namespace posevote
