// SPDX-License-Identifier: BSD-3-Clause
// Units of length that files may be in, and how to tell that one was mistaken for another.
#pragma once

#include <string>
#include <vector>

namespace posevote::formats {

/// "mm", "cm", "m" and "in".
const std::vector<std::string>& length_units();

/// Metres per one of length_units(). Throws std::invalid_argument for any other.
double metres_per(const std::string& unit);

}  // namespace posevote::formats
