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

/// weight_units of kernel.hpp. The result is a whole number, at most 2^25.
HWY_INLINE U weight_units(const Kernel& k, F dt2, F e2) {
  const Floats d;
  F s = hn::Set(d, k.angle[4]);
  for (int i = 3; i >= 0; --i) s = hn::Add(hn::Mul(s, e2), hn::Set(d, k.angle[i]));
  s = hn::Add(hn::Mul(s, e2), hn::Mul(dt2, hn::Set(d, k.per_dt2)));
  F units = hn::Set(d, k.exponential[6]);
  for (int i = 5; i >= 0; --i) units = hn::Add(hn::Mul(units, s), hn::Set(d, k.exponential[i]));
  return hn::BitCast(Units(), hn::ConvertTo(hn::RebindToSigned<Floats>(), units));
}

/// Sums of weights, lane by lane.
class Total {
 public:
  HWY_INLINE Total() : lanes_(hn::Zero(Units())) {}

  HWY_INLINE void add(U weights) {
    lanes_ = hn::Add(lanes_, weights);
    if (HWY_UNLIKELY(++count_ == kMostWeights)) spill();
  }

  HWY_INLINE std::uint64_t value() {
    spill();
    return value_;
  }

 private:
  HWY_INLINE void spill() {
    HWY_ALIGN std::uint32_t lanes[HWY_LANES(std::uint32_t)];
    hn::Store(lanes_, Units(), lanes);
    for (std::size_t i = 0; i < hn::Lanes(Units()); ++i) value_ += lanes[i];
    lanes_ = hn::Zero(Units());
    count_ = 0;
  }

  U lanes_;
  std::uint32_t count_ = 0;
  std::uint64_t value_ = 0;
};

/// (a - b)^2
HWY_INLINE F squared_difference(F a, const float* b) {
  const F difference = hn::Sub(a, hn::LoadU(Floats(), b));
  return hn::Mul(difference, difference);
}

/// A query, each number in every lane.
class Query {
 public:
  HWY_INLINE Query(const Kernel& k, const VotePoint& p, float sign) {
    const Floats d;
    tx_ = hn::Set(d, p.tx);
    ty_ = hn::Set(d, p.ty);
    tz_ = hn::Set(d, p.tz);
    qw_ = hn::Set(d, sign * p.qw);
    qx_ = hn::Set(d, sign * p.qx);
    qy_ = hn::Set(d, sign * p.qy);
    qz_ = hn::Set(d, sign * p.qz);
    max_dt2_ = hn::Set(d, k.max_dt2);
    max_e2_ = hn::Set(d, k.max_e2);
  }

  /// The weights of the votes from i on, where `valid`; 0 for those that are not near.
  HWY_INLINE U weights(const Kernel& kernel, const VoteColumns& c, std::size_t i,
                       hn::Mask<Floats> valid) const {
    const F xy = hn::Add(squared_difference(tx_, c.tx + i), squared_difference(ty_, c.ty + i));
    const F dt2 = hn::Add(xy, squared_difference(tz_, c.tz + i));
    const F wx = hn::Add(squared_difference(qw_, c.qw + i), squared_difference(qx_, c.qx + i));
    const F yz = hn::Add(squared_difference(qy_, c.qy + i), squared_difference(qz_, c.qz + i));
    const F e2 = hn::Add(wx, yz);
    const auto near = hn::And(hn::Le(dt2, max_dt2_), hn::Le(e2, max_e2_));
    return hn::IfThenElseZero(hn::RebindMask(Units(), hn::And(near, valid)),
                              weight_units(kernel, dt2, e2));
  }

 private:
  F tx_, ty_, tz_, qw_, qx_, qy_, qz_, max_dt2_, max_e2_;
};

template <bool kBack>
HWY_INLINE std::uint64_t scan_ranges(const Kernel& kernel, const VoteColumns& columns,
                                     const VotePoint& point, const ScanRange* ranges,
                                     std::size_t range_count, std::uint32_t* back) {
  const Floats d;
  const Units units;
  const std::size_t lanes = hn::Lanes(d);
  Total total;
  for (std::size_t r = 0; r < range_count; ++r) {
    const Query query(kernel, point, ranges[r].sign);
    const std::size_t end = ranges[r].end;
    for (std::size_t i = ranges[r].begin; i < end; i += lanes) {
      const U weights = query.weights(kernel, columns, i, hn::FirstN(d, std::min(lanes, end - i)));
      total.add(weights);
      if (kBack) hn::StoreU(hn::Add(hn::LoadU(units, back + i), weights), units, back + i);
    }
  }
  return total.value();
}

std::uint64_t scan(const Kernel& kernel, const VoteColumns& columns, const VotePoint& point,
                   const ScanRange* ranges, std::size_t range_count, std::uint32_t* back) {
  return back == nullptr ? scan_ranges<false>(kernel, columns, point, ranges, range_count, back)
                         : scan_ranges<true>(kernel, columns, point, ranges, range_count, back);
}

}  // namespace posevote::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote {

HWY_EXPORT(scan);

std::uint64_t scan_votes(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         const ScanRange* ranges, std::size_t range_count, std::uint32_t* back) {
  return HWY_DYNAMIC_DISPATCH(scan)(kernel, columns, query, ranges, range_count, back);
}

}  // namespace posevote
#endif
