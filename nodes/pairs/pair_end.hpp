// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace posevote::pairs {

/// One end of a pair of a model's points, and the turn about it at which the other end lies.
struct PairEnd {
  std::uint16_t point = 0;  ///< its number among the table's points
  std::uint8_t turn = 0;    ///< of LocalFrame
  std::uint8_t color = 0;   ///< color_step to the other end, where the table has colours
};

}  // namespace posevote::pairs
