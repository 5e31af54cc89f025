// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of PairVotes. No header of Eigen here, as in grid_run.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/pairs/pair_end.hpp"

namespace posevote::pairs {

/// Ends of a table that lie one behind the other, and a turn, in 256ths of a circle.
struct TurnedRun {
  std::uint32_t begin, end;
  std::uint8_t turn;
};

/// Ends behind the last that may be read.
constexpr std::size_t kEndPadding = 16;

/// Turns that are told apart where a frame leaves them open.
constexpr std::uint32_t kTurns = 32;

/// Where a frame leaves no turn open: adds one to counts[end.point] for each end of the runs whose
/// turn is the run's or at most `span` ahead of it, around the circle.
void count_turned(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                  std::uint8_t span, std::uint16_t* counts);

/// Where it does: adds one to counts[kTurns * end.point + turn] for each end, where the turn is how
/// far the run's is ahead of its own.
void count_turns(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                 std::uint16_t* counts);

}  // namespace posevote::pairs
