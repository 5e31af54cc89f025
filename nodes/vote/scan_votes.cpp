// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs. Raw
// pointers only: a type shared with code built for another instruction set must not be instantiated
// here. The arithmetic mirrors kernel.hpp operation for operation, with Mul and Add and never a
// fused MulAdd.
#include "nodes/vote/scan_votes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/vote/scan_votes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Units = hn::RebindToUnsigned<Floats>;
using F = hn::Vec<Floats>;
using U = hn::Vec<Units>;

/// weight_units of kernel.hpp. The result is a whole number below 2^25 + 1.
HWY_INLINE U weight_units(const Kernel& k, F dt2, F e2) {
  const Floats d;
  F s = hn::Set(d, k.angle[4]);
  for (int i = 3; i >= 0; --i) s = hn::Add(hn::Mul(s, e2), hn::Set(d, k.angle[i]));
  s = hn::Add(hn::Mul(s, e2), hn::Mul(dt2, hn::Set(d, k.per_dt2)));
  F units = hn::Set(d, k.exponential[6]);
  for (int i = 5; i >= 0; --i) units = hn::Add(hn::Mul(units, s), hn::Set(d, k.exponential[i]));
  return hn::BitCast(Units(), hn::ConvertTo(hn::RebindToSigned<Floats>(), units));
}

/// (a - b)^2
HWY_INLINE F squared_difference(F a, const float* b) {
  const F difference = hn::Sub(a, hn::LoadU(Floats(), b));
  return hn::Mul(difference, difference);
}

/// Sum of the lanes of 32 bits, in 64.
HWY_INLINE std::uint64_t sum_of_lanes(U units) {
  HWY_ALIGN std::uint32_t lanes[HWY_LANES(std::uint32_t)];
  hn::Store(units, Units(), lanes);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < hn::Lanes(Units()); ++i) sum += lanes[i];
  return sum;
}

struct Query {
  F tx, ty, tz, qw, qx, qy, qz;
};

HWY_INLINE Query broadcast(const VotePoint& q, float sign) {
  const Floats d;
  return {hn::Set(d, q.tx),        hn::Set(d, q.ty),        hn::Set(d, q.tz),
          hn::Set(d, sign * q.qw), hn::Set(d, sign * q.qx), hn::Set(d, sign * q.qy),
          hn::Set(d, sign * q.qz)};
}

/// What the lanes from i on add to the density, where `valid`.
HWY_INLINE U scan_block(const Kernel& k, const VoteColumns& c, const Query& q, std::size_t i,
                        hn::Mask<Floats> valid) {
  const Floats d;
  const F dt2 =
      hn::Add(hn::Add(squared_difference(q.tx, c.tx + i), squared_difference(q.ty, c.ty + i)),
              squared_difference(q.tz, c.tz + i));
  const F e2 =
      hn::Add(hn::Add(squared_difference(q.qw, c.qw + i), squared_difference(q.qx, c.qx + i)),
              hn::Add(squared_difference(q.qy, c.qy + i), squared_difference(q.qz, c.qz + i)));
  const auto near =
      hn::And(hn::And(hn::Le(dt2, hn::Set(d, k.max_dt2)), hn::Le(e2, hn::Set(d, k.max_e2))), valid);
  if (hn::AllFalse(d, near)) return hn::Zero(Units());
  return hn::IfThenElseZero(hn::RebindMask(Units(), near), weight_units(k, dt2, e2));
}

std::uint64_t scan(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                   const ScanRange* ranges, std::size_t range_count) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  constexpr int kBlocksBeforeOverflow = 127;  // of 2^25 each in 32 bits
  std::uint64_t total = 0;
  U sum = hn::Zero(Units());
  int blocks = 0;
  for (std::size_t r = 0; r < range_count; ++r) {
    const Query q = broadcast(query, ranges[r].sign);
    for (std::size_t i = ranges[r].begin; i < ranges[r].end; i += lanes) {
      sum =
          hn::Add(sum, scan_block(kernel, columns, q, i,
                                  hn::FirstN(d, std::min<std::size_t>(lanes, ranges[r].end - i))));
      if (++blocks < kBlocksBeforeOverflow) continue;
      total += sum_of_lanes(sum);
      sum = hn::Zero(Units());
      blocks = 0;
    }
  }
  return total + sum_of_lanes(sum);
}

}  // namespace posevote::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote {

HWY_EXPORT(scan);

std::uint64_t scan_votes(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         const ScanRange* ranges, std::size_t range_count) {
  return HWY_DYNAMIC_DISPATCH(scan)(kernel, columns, query, ranges, range_count);
}

}  // namespace posevote
#endif
