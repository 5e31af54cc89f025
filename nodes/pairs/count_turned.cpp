// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs.
//
// What is to be counted is gathered a vector at a time and counted from there. Where turns are known
// one end in nine counts, and which ones cannot be foreseen: no branch asks for it.
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
constexpr int kTurnBits = 5;        // of 8, that are told apart
static_assert(1 << kTurnBits == kTurns);
constexpr std::int32_t kTurn = 255, kPoint = 65535;

/// Places to be counted.
class Gathered {
 public:
  explicit Gathered(std::uint16_t* counts) : counts_(counts) {}

  template <class Mask>
  HWY_INLINE void add(hn::Vec<Ends> places, Mask counted) {
    const Ends d;
    hn::StoreU(hn::Compress(places, counted), d, places_ + size_);
    size_ += hn::CountTrue(d, counted);
    if (size_ > kRoom - kEndPadding) count();
  }
  HWY_INLINE void count() {
    for (std::size_t k = 0; k < size_; ++k) ++counts_[places_[k]];
    size_ = 0;
  }

 private:
  std::uint16_t* counts_;
  std::size_t size_ = 0;
  HWY_ALIGN std::int32_t places_[kRoom + kEndPadding];  // Compress may write a whole vector
};

/// Calls visit(run, ends, mask of those that are the run's) for all ends.
template <class Visit>
HWY_INLINE void for_each(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                         const Visit& visit) {
  const Ends d;
  const auto* words = reinterpret_cast<const std::int32_t*>(ends);
  for (std::size_t r = 0; r < run_count; ++r) {
    if (r + kAhead < run_count) __builtin_prefetch(words + runs[r + kAhead].begin);
    for (std::size_t i = runs[r].begin; i < runs[r].end; i += hn::Lanes(d))
      visit(runs[r], hn::LoadU(d, words + i),
            hn::FirstN(d, std::min<std::size_t>(hn::Lanes(d), runs[r].end - i)));
  }
}

void turned(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count, std::uint8_t span,
            std::uint16_t* counts) {
  const Ends d;
  const auto turn_mask = hn::Set(d, kTurn), point_mask = hn::Set(d, kPoint);
  const auto beyond = hn::Set(d, span + 1);
  Gathered points(counts);
  for_each(ends, runs, run_count, [&](const TurnedRun& run, auto end, auto valid) HWY_ATTR {
    const auto first = hn::Set(d, std::int32_t{run.turn});
    const auto ahead = hn::And(hn::Sub(hn::ShiftRight<kTurnAt>(end), first), turn_mask);
    points.add(hn::And(end, point_mask), hn::And(hn::Lt(ahead, beyond), valid));
  });
  points.count();
}

void turns(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
           std::uint16_t* counts) {
  const Ends d;
  const auto turn_mask = hn::Set(d, kTurn), point_mask = hn::Set(d, kPoint);
  Gathered places(counts);
  for_each(ends, runs, run_count, [&](const TurnedRun& run, auto end, auto valid) HWY_ATTR {
    const auto turn = hn::Set(d, std::int32_t{run.turn});
    const auto off = hn::And(hn::Sub(turn, hn::ShiftRight<kTurnAt>(end)), turn_mask);
    const auto first = hn::ShiftLeft<kTurnBits>(hn::And(end, point_mask));
    places.add(hn::Add(first, hn::ShiftRight<8 - kTurnBits>(off)), valid);
  });
  places.count();
}

}  // namespace posevote::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::pairs {

HWY_EXPORT(turned);
HWY_EXPORT(turns);

void count_turned(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                  std::uint8_t span, std::uint16_t* counts) {
  HWY_DYNAMIC_DISPATCH(turned)(ends, runs, run_count, span, counts);
}

void count_turns(const PairEnd* ends, const TurnedRun* runs, std::size_t run_count,
                 std::uint16_t* counts) {
  HWY_DYNAMIC_DISPATCH(turns)(ends, runs, run_count, counts);
}

}  // namespace posevote::pairs
#endif
