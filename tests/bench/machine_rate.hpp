// SPDX-License-Identifier: BSD-3-Clause
// What the machine can do at best on one core, for kernels to be held against.
#pragma once

#include <cstddef>

namespace posevote {

/// Multiplies and adds on registers, neither fused nor waiting for each other. Returns how many
/// numbers were multiplied or added; `sink` keeps it from being left out.
double do_arithmetic(std::size_t rounds, float* sink);

/// The sum of an array, a vector at a time.
float read_all(const float* values, std::size_t count);

}  // namespace posevote
