// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs.
//
// One end in nine counts, and which ones cannot be foreseen: so those are gathered without a branch,
// a vector at a time, and counted from there.
#include "nodes/pairs/count_turned.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/pairs/count_turned.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::pairs::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Ends = hn::CappedTag<std::int32_t, kEndPadding>;  // each an end, its point in the low half

static_assert(sizeof(PairEnd) == sizeof(std::int32_t));

constexpr std::size_t kRoom = 256;  // points gathered before they are counted
constexpr std::size_t kAhead = 8;   // runs, between a fetch and what it is for
constexpr int kTurnAt = 16;         // bits before an end's turn
constexpr std::int32_t kTurn = 255, kPoint = 65535;

void count(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count, std::uint8_t span,
           std::uint16_t* counts) {
  const Ends d;
  const auto* words = reinterpret_cast<const std::int32_t*>(ends);
  const auto turn_mask = hn::Set(d, kTurn), point_mask = hn::Set(d, kPoint);
  const auto beyond = hn::Set(d, span + 1);
  HWY_ALIGN std::int32_t points[kRoom + kEndPadding];  // Compress may write a whole vector
  std::size_t gathered = 0;
  const auto count_gathered = [&] {
    for (std::size_t k = 0; k < gathered; ++k) ++counts[points[k]];
    gathered = 0;
  };
  for (std::size_t r = 0; r < run_count; ++r) {
    if (r + kAhead < run_count) __builtin_prefetch(words + runs[r + kAhead].begin);
    const auto first = hn::Set(d, runs[r].first_turn);
    for (std::size_t i = runs[r].begin; i < runs[r].end; i += hn::Lanes(d)) {
      const auto end = hn::LoadU(d, words + i);
      const auto ahead = hn::And(hn::Sub(hn::ShiftRight<kTurnAt>(end), first), turn_mask);
      const auto valid = hn::FirstN(d, std::min<std::size_t>(hn::Lanes(d), runs[r].end - i));
      const auto counted = hn::And(hn::Lt(ahead, beyond), valid);
      hn::StoreU(hn::Compress(hn::And(end, point_mask), counted), d, points + gathered);
      gathered += hn::CountTrue(d, counted);
      if (gathered > kRoom - kEndPadding) count_gathered();
    }
  }
  count_gathered();
}

}  // namespace posevote::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::pairs {

HWY_EXPORT(count);

void count_turned(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                  std::uint8_t span, std::uint16_t* counts) {
  HWY_DYNAMIC_DISPATCH(count)(ends, runs, run_count, span, counts);
}

}  // namespace posevote::pairs
#endif
