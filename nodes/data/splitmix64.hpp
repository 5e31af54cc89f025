// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace posevote {

/// Vigna's splitmix64: a bijection whose output bits all depend on all input bits.
inline std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

}  // namespace posevote
