// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs. Raw
// pointers only: a type shared with code built for another instruction set must not be instantiated
// here. The arithmetic mirrors kernel.hpp operation for operation, with Mul and Add and never a
// fused MulAdd; that is for looking alone, which decides nothing.
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

/// weight_units of kernel.hpp where `near`, else 0.
HWY_INLINE U weight_units(const Kernel& k, F dt2, F e2, hn::Mask<Floats> near) {
  const Floats d;
  const auto line = [d](const float* a, F x) HWY_ATTR {  // a[0] + a[1] x
    return hn::Add(hn::Set(d, a[0]), hn::Mul(hn::Set(d, a[1]), x));
  };
  const F e4 = hn::Mul(e2, e2);
  const F angle = hn::Add(line(k.angle, e2), hn::Mul(line(k.angle + 2, e2), e4));
  const F s = hn::Add(hn::Mul(angle, e2), hn::Mul(dt2, hn::Set(d, k.per_dt2)));
  const F s2 = hn::Mul(s, s);
  const F upper = hn::Add(line(k.exponential + 2, s), hn::Mul(line(k.exponential + 4, s), s2));
  const F sum = hn::Add(line(k.exponential, s), hn::Mul(upper, s2));
  const U bits = hn::And(hn::BitCast(Units(), sum), hn::Set(Units(), kMantissa));
  return hn::IfThenElseZero(hn::RebindMask(Units(), near), bits);
}

constexpr std::size_t kMaskBytes = 8;  // read and written at once, however few there are

/// (a - b)^2
HWY_INLINE F squared_difference(F a, const float* b) {
  const F difference = hn::Sub(a, hn::LoadU(Floats(), b));
  return hn::Mul(difference, difference);
}

/// A vector with votes whose rotations may be near, and masks of its lanes.
struct Found {
  std::uint32_t first;
  std::uint8_t in_range[kMaskBytes];
  std::uint8_t negative[kMaskBytes];  ///< of which -q is nearer
};

/// A query, each number in every lane.
class Query {
 public:
  HWY_INLINE Query(const Kernel& k, const VotePoint& p) {
    const Floats d;
    tx_ = hn::Set(d, p.tx);
    ty_ = hn::Set(d, p.ty);
    tz_ = hn::Set(d, p.tz);
    qw_ = hn::Set(d, p.qw);
    qx_ = hn::Set(d, p.qx);
    qy_ = hn::Set(d, p.qy);
    qz_ = hn::Set(d, p.qz);
    min_cosine_ = hn::Set(d, k.min_cosine);
    max_dt2_ = hn::Set(d, k.max_dt2);
    max_e2_ = hn::Set(d, k.max_e2);
  }

  /// To look first and weigh then spares the processor branches that it cannot foresee. Vectors
  /// begin at multiples of their length: others would lie across two lines of the cache.
  HWY_INLINE Found* find_near(const VoteColumns& c, IndexRange range, Found* found) const {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    const float *w = c[3], *x = c[4], *y = c[5], *z = c[6];
    const auto look = [&](std::size_t i, hn::Mask<Floats> in_range) HWY_ATTR {
      F sum = hn::Mul(qw_, hn::LoadU(d, w + i));
      sum = hn::MulAdd(qx_, hn::LoadU(d, x + i), sum);
      sum = hn::MulAdd(qy_, hn::LoadU(d, y + i), sum);
      sum = hn::MulAdd(qz_, hn::LoadU(d, z + i), sum);
      found->first = static_cast<std::uint32_t>(i);
      hn::StoreMaskBits(d, in_range, found->in_range);
      hn::StoreMaskBits(d, hn::Lt(sum, hn::Zero(d)), found->negative);
      found += !hn::AllFalse(d, hn::Ge(hn::Abs(sum), min_cosine_));
    };
    std::size_t i = range.begin / lanes * lanes;
    const std::size_t end = range.end;
    look(i, hn::AndNot(hn::FirstN(d, range.begin - i), hn::FirstN(d, std::min(lanes, end - i))));
    for (i += lanes; i + lanes <= end; i += lanes) look(i, hn::FirstN(d, lanes));
    if (i < end) look(i, hn::FirstN(d, end - i));
    return found;
  }

  /// The weights of a vector; 0 for the votes that are not near.
  HWY_INLINE U weights(const Kernel& kernel, const VoteColumns& c, const Found& vector) const {
    const Floats d;
    const std::size_t i = vector.first;
    const F xy = hn::Add(squared_difference(tx_, c[0] + i), squared_difference(ty_, c[1] + i));
    const F dt2 = hn::Add(xy, squared_difference(tz_, c[2] + i));
    const F sign = hn::IfThenElseZero(hn::LoadMaskBits(d, vector.negative), hn::Set(d, -0.0F));
    const F wx = hn::Add(squared_difference(hn::Xor(qw_, sign), c[3] + i),
                         squared_difference(hn::Xor(qx_, sign), c[4] + i));
    const F yz = hn::Add(squared_difference(hn::Xor(qy_, sign), c[5] + i),
                         squared_difference(hn::Xor(qz_, sign), c[6] + i));
    const F e2 = hn::Add(wx, yz);
    const auto near = hn::And(hn::Le(dt2, max_dt2_), hn::Le(e2, max_e2_));
    return weight_units(kernel, dt2, e2, hn::And(near, hn::LoadMaskBits(d, vector.in_range)));
  }

 private:
  F tx_, ty_, tz_, qw_, qx_, qy_, qz_, min_cosine_, max_dt2_, max_e2_;
};

/// Most vectors that find_near is asked for at a time, but for one that a range may have more as it
/// begins within a vector.
constexpr std::size_t kRoom = 128;

/// Of at most kMostWeights vectors.
template <bool kBack>
HWY_INLINE std::uint64_t weigh(const Kernel& kernel, const VoteColumns& columns, const Query& query,
                               const Found* found, std::size_t size, std::uint32_t* back) {
  const Units units;
  U total = hn::Zero(units);
  for (const Found* one = found; one < found + size; ++one) {
    const U weights = query.weights(kernel, columns, *one);
    total = hn::Add(total, weights);
    if constexpr (kBack) {
      std::uint32_t* here = back + one->first;
      hn::StoreU(hn::Add(hn::LoadU(units, here), weights), units, here);
    }
  }
  HWY_ALIGN std::uint32_t lanes[HWY_LANES(std::uint32_t)];
  hn::Store(total, units, lanes);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < hn::Lanes(units); ++i) sum += lanes[i];
  return sum;
}

template <bool kBack>
HWY_INLINE std::uint64_t scan_ranges(const Kernel& kernel, const VoteColumns& columns,
                                     const VotePoint& point, const IndexRange* ranges,
                                     std::size_t range_count, std::uint32_t* back) {
  Found found[2 * kRoom + 2];  // one is free
  static_assert(2 * kRoom + 1 <= kMostWeights);
  const auto step = static_cast<std::uint32_t>(kRoom * hn::Lanes(Floats()));
  const Query query(kernel, point);
  std::size_t size = 0;
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < range_count; ++r) {
    IndexRange part = ranges[r];
    for (; part.begin < ranges[r].end; part.begin = part.end) {
      part.end = std::min(ranges[r].end - part.begin, step) + part.begin;
      size = static_cast<std::size_t>(query.find_near(columns, part, found + size) - found);
      if (size <= kRoom) continue;
      sum += weigh<kBack>(kernel, columns, query, found, size, back);
      size = 0;
    }
  }
  return sum + weigh<kBack>(kernel, columns, query, found, size, back);
}

std::uint64_t scan(const Kernel& kernel, const VoteColumns& columns, const VotePoint& point,
                   const IndexRange* ranges, std::size_t range_count, std::uint32_t* back) {
  return back == nullptr ? scan_ranges<false>(kernel, columns, point, ranges, range_count, back)
                         : scan_ranges<true>(kernel, columns, point, ranges, range_count, back);
}

std::size_t collect(const Kernel& kernel, const VoteColumns& columns, const VotePoint& point,
                    IndexRange range, std::uint32_t* places, std::uint32_t* weights) {
  const Units units;
  const auto step = static_cast<std::uint32_t>(kRoom * hn::Lanes(Floats()));
  const Query query(kernel, point);
  const U lane = hn::Iota(units, 0);
  Found found[kRoom + 2];
  std::size_t count = 0;
  for (IndexRange part = range; part.begin < range.end; part.begin = part.end) {
    part.end = std::min(range.end - part.begin, step) + part.begin;
    const Found* end = query.find_near(columns, part, found);
    for (const Found* one = found; one < end; ++one) {
      const U weight = query.weights(kernel, columns, *one);
      const auto near = hn::Ne(weight, hn::Zero(units));
      const U place = hn::Add(lane, hn::Set(units, one->first));
      hn::StoreU(hn::Compress(place, near), units, places + count);
      hn::StoreU(hn::Compress(weight, near), units, weights + count);
      count += hn::CountTrue(units, near);
    }
  }
  return count;
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

}  // namespace posevote::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote {

HWY_EXPORT(scan);
HWY_EXPORT(collect);
HWY_EXPORT(copy);

std::uint64_t scan_votes(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         const IndexRange* ranges, std::size_t range_count, std::uint32_t* back) {
  return HWY_DYNAMIC_DISPATCH(scan)(kernel, columns, query, ranges, range_count, back);
}

std::size_t collect_near(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         IndexRange range, std::uint32_t* places, std::uint32_t* weights) {
  return HWY_DYNAMIC_DISPATCH(collect)(kernel, columns, query, range, places, weights);
}

std::size_t copy_near(const Kernel& kernel, const VoteColumns& columns, IndexRange range,
                      const VoteBox& box, float* to, std::size_t stride, std::uint32_t* numbers) {
  return HWY_DYNAMIC_DISPATCH(copy)(kernel, columns, range, box, to, stride, numbers);
}

}  // namespace posevote
#endif
