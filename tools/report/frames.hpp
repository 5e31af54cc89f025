// SPDX-License-Identifier: BSD-3-Clause
// The table of a run's frames, with their pictures.
#pragma once

#include <filesystem>
#include <string>

#include "tools/report/run_results.hpp"

namespace posevote {

/// `pictures`: how many the page still may hold; those that are used are taken off. In parts that
/// can be folded, the first of them `open`: pages of thousands of frames stay quick.
std::string frames_markup(const RunResults& run, const std::filesystem::path& folder,
                          std::size_t& pictures, bool open);

}  // namespace posevote
