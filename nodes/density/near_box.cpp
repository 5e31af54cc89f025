// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs. Raw
// pointers only: a type shared with code built for another instruction set must not be instantiated
// here.
#include "nodes/density/near_box.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/density/near_box.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::density::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Units = hn::RebindToUnsigned<Floats>;
using F = hn::Vec<Floats>;
using U = hn::Vec<Units>;

/// The least and the largest number of a range of one coordinate.
HWY_INLINE void range_of(const float* numbers, IndexRange range, float* low, float* high) {
  const Floats d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  F lowest = hn::Set(d, numbers[range.begin]), highest = lowest;
  std::uint32_t i = range.begin;
  for (; i + lanes <= range.end; i += lanes) {
    const F next = hn::LoadU(d, numbers + i);
    lowest = hn::Min(lowest, next);
    highest = hn::Max(highest, next);
  }
  *low = hn::GetLane(hn::MinOfLanes(d, lowest));
  *high = hn::GetLane(hn::MaxOfLanes(d, highest));
  for (; i < range.end; ++i) {
    *low = std::min(*low, numbers[i]);
    *high = std::max(*high, numbers[i]);
  }
}

void bound(const VoteColumns& votes, IndexRange range, VoteBox* box) {
  for (std::size_t a = 0; a < 3; ++a) range_of(votes[a], range, box->low + a, box->high + a);
}

/// The squared distance of a coordinate from an interval. Never above that from any number inside:
/// rounding is monotone, and the order of operations that of the kernel's squared_distance.
HWY_INLINE F squared_gap(F low, F high, const float* at) {
  const Floats d;
  const F t = hn::LoadU(d, at);
  const F gap = hn::Max(hn::Max(hn::Sub(low, t), hn::Sub(t, high)), hn::Zero(d));
  return hn::Mul(gap, gap);
}

std::size_t copy(const Kernel& kernel, const VoteColumns& columns, IndexRange range,
                 const VoteBox& box, float* to, std::size_t stride, std::uint32_t* numbers) {
  const Floats d;
  const Units units;
  const std::size_t lanes = hn::Lanes(d);
  F low[3], high[3];
  for (int a = 0; a < 3; ++a) {
    low[a] = hn::Set(d, box.low[a]);
    high[a] = hn::Set(d, box.high[a]);
  }
  const F max_dt2 = hn::Set(d, kernel.max_dt2);
  const U lane = hn::Iota(units, 0);  // in the loop it would be made in memory
  std::size_t count = 0;
  for (std::size_t i = range.begin; i < range.end; i += lanes) {
    const F xy = hn::Add(squared_gap(low[0], high[0], columns[0] + i),
                         squared_gap(low[1], high[1], columns[1] + i));
    const F dt2 = hn::Add(xy, squared_gap(low[2], high[2], columns[2] + i));
    const auto near = hn::And(hn::Le(dt2, max_dt2), hn::FirstN(d, std::min(lanes, range.end - i)));
    for (std::size_t c = 0; c < kVoteColumns; ++c)
      hn::StoreU(hn::Compress(hn::LoadU(d, columns[c] + i), near), d, to + c * stride + count);
    const U number = hn::Add(lane, hn::Set(units, static_cast<std::uint32_t>(i)));
    hn::StoreU(hn::Compress(number, hn::RebindMask(units, near)), units, numbers + count);
    count += hn::CountTrue(d, near);
  }
  return count;
}

}  // namespace posevote::density::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::density {

HWY_EXPORT(bound);
HWY_EXPORT(copy);

VoteBox bounding_box(const VoteColumns& votes, IndexRange range) {
  VoteBox box;
  HWY_DYNAMIC_DISPATCH(bound)(votes, range, &box);
  return box;
}

std::size_t copy_near(const Kernel& kernel, const VoteColumns& columns, IndexRange range,
                      const VoteBox& box, float* to, std::size_t stride, std::uint32_t* numbers) {
  return HWY_DYNAMIC_DISPATCH(copy)(kernel, columns, range, box, to, stride, numbers);
}

}  // namespace posevote::density
#endif
