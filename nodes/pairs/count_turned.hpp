// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of PairVotes where a frame leaves no turn open. No header of Eigen here, as in
// grid_run.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/pairs/pair_end.hpp"

namespace posevote::pairs {

/// Ends of a table that lie one behind the other.
struct TurnedRun {
  std::uint32_t begin, end;
  std::uint8_t first_turn;  ///< of those that count, in 256ths of a circle
};

/// Ends behind the last that may be read.
constexpr std::size_t kEndPadding = 16;

/// Adds one to counts[end.point] for each end of the runs whose turn is the run's first one or at most
/// `span` ahead of it, around the circle.
void count_turned(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                  std::uint8_t span, std::uint16_t* counts);

}  // namespace posevote::pairs
