// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs. Raw
// pointers only: a type shared with code built for another instruction set must not be instantiated
// here. The arithmetic mirrors kernel.hpp operation for operation, with Mul and Add; fused are only
// products that are exact, and those that say where to look, which decide nothing.
#include "nodes/density/scan_votes.hpp"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/density/scan_votes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::density::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Units = hn::RebindToUnsigned<Floats>;
using F = hn::Vec<Floats>;
using U = hn::Vec<Units>;

static_assert(kBlock % HWY_LANES(float) == 0, "a block is whole vectors");

HWY_INLINE F polynomial(const float (&a)[5], F x) {
  const Floats d;
  const F x2 = hn::Mul(x, x);
  const F lower = hn::Add(hn::Set(d, a[0]), hn::Mul(hn::Set(d, a[1]), x));
  const F upper = hn::Add(hn::Add(hn::Set(d, a[2]), hn::Mul(hn::Set(d, a[3]), x)),
                          hn::Mul(hn::Set(d, a[4]), x2));
  return hn::Add(lower, hn::Mul(upper, x2));
}

/// weight_units of kernel.hpp where `near`, else 0.
HWY_INLINE U weight_units(const Kernel& k, F dt2, F e2, hn::Mask<Floats> near) {
  const F share = hn::Mul(dt2, hn::Set(Floats(), k.per_dt2));
  const F units = hn::Mul(polynomial(k.translation, share), polynomial(k.rotation, e2));
  const F whole = hn::Add(hn::IfThenElseZero(near, units), hn::Set(Floats(), kWholeNumbers));
  return hn::And(hn::BitCast(Units(), whole), hn::Set(Units(), kMantissa));
}

HWY_INLINE F squared(F a) { return hn::Mul(a, a); }

/// As many quaternions as a vector has lanes.
struct Rotations {
  F w, x, y, z;
};

HWY_INLINE Rotations rotations_from(const VoteColumns& votes, std::size_t i) {
  const Floats d;
  return {hn::LoadU(d, votes[3] + i), hn::LoadU(d, votes[4] + i), hn::LoadU(d, votes[5] + i),
          hn::LoadU(d, votes[6] + i)};
}

/// A query, each number in every lane.
class Query {
 public:
  HWY_INLINE Query(const Kernel& kernel, const VotePoint& p) : kernel_(kernel) {
    const Floats d;
    tx_ = hn::Set(d, p.tx);
    ty_ = hn::Set(d, p.ty);
    tz_ = hn::Set(d, p.tz);
    qw_ = hn::Set(d, p.qw);
    qx_ = hn::Set(d, p.qx);
    qy_ = hn::Set(d, p.qy);
    qz_ = hn::Set(d, p.qz);
    min_cosine_ = hn::Set(d, kernel.min_cosine);
    max_dt2_ = hn::Set(d, kernel.max_dt2);
    max_e2_ = hn::Set(d, kernel.max_e2);
  }

  /// Whether any of these rotations may be near.
  HWY_INLINE bool may_meet(const Rotations& others) const {
    return !hn::AllFalse(Floats(), hn::Ge(hn::Abs(cosine(others)), min_cosine_));
  }

  /// The weights of the votes from i on, as many as a vector has lanes; 0 where they are not near.
  HWY_INLINE U weights(const VoteColumns& votes, std::size_t i) const {
    const Floats d;
    const F dx = hn::Sub(tx_, hn::LoadU(d, votes[0] + i));
    const F dy = hn::Sub(ty_, hn::LoadU(d, votes[1] + i));
    const F dz = hn::Sub(tz_, hn::LoadU(d, votes[2] + i));
    const F dt2 = hn::Add(hn::Add(squared(dx), squared(dy)), squared(dz));
    const Rotations q = rotations_from(votes, i);
    // The nearer of q and -q counts; a product with 1 or -1 is exact, fused or not.
    const F sign = hn::CopySignToAbs(hn::Set(d, 1), cosine(q));
    const F wx =
        hn::Add(squared(hn::NegMulAdd(sign, q.w, qw_)), squared(hn::NegMulAdd(sign, q.x, qx_)));
    const F yz =
        hn::Add(squared(hn::NegMulAdd(sign, q.y, qy_)), squared(hn::NegMulAdd(sign, q.z, qz_)));
    const F e2 = hn::Add(wx, yz);
    return weight_units(kernel_, dt2, e2, hn::And(hn::Le(dt2, max_dt2_), hn::Le(e2, max_e2_)));
  }

 private:
  /// The cosine of the angle between the quaternions. Fused: it only says where to look and which
  /// sign to take.
  HWY_INLINE F cosine(const Rotations& q) const {
    const F sum = hn::MulAdd(qx_, q.x, hn::Mul(qw_, q.w));
    return hn::MulAdd(qz_, q.z, hn::MulAdd(qy_, q.y, sum));
  }

  const Kernel& kernel_;
  F tx_, ty_, tz_, qw_, qx_, qy_, qz_, min_cosine_, max_dt2_, max_e2_;
};

/// The vectors that a query may meet: where each begins.
struct Found {
  std::uint32_t* first;
  std::size_t count;
};

/// Finds the votes near the first kQueries. To look first and weigh then spares the processor branches that it cannot
/// foresee; a group shares the loads.
template <std::size_t kQueries>
HWY_INLINE void find(const Query (&queries)[kGroup], const VoteColumns& votes, const Blocks& blocks,
                     Found (&found)[kGroup]) {
  for (std::size_t r = 0; r < blocks.count; ++r) {
    const std::uint32_t end = blocks.ranges[r].end * kBlock;
    for (std::uint32_t i = blocks.ranges[r].begin * kBlock; i < end;
         i += static_cast<std::uint32_t>(hn::Lanes(Floats()))) {
      const Rotations others = rotations_from(votes, i);
      bool may_meet[kQueries];  // all before the first is written: that might be what is read
      for (std::size_t k = 0; k < kQueries; ++k) may_meet[k] = queries[k].may_meet(others);
      for (std::size_t k = 0; k < kQueries; ++k) {
        found[k].first[found[k].count] = i;
        found[k].count += may_meet[k];
      }
    }
  }
}

HWY_INLINE std::uint64_t sum_of_lanes(U total) {
  HWY_ALIGN std::uint32_t lanes[HWY_LANES(std::uint32_t)];
  hn::Store(total, Units(), lanes);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < hn::Lanes(Units()); ++i) sum += lanes[i];
  return sum;
}

/// If kMutual, adds what each vote weighs to `back`.
template <bool kMutual>
HWY_INLINE std::uint64_t weigh(const Query& query, const VoteColumns& votes, const Found& found,
                               std::uint32_t* back) {
  const Units units;
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < found.count;) {
    const std::size_t end = std::min<std::size_t>(found.count, k + kMostWeights);
    U total = hn::Zero(units);
    for (; k < end; ++k) {
      const std::uint32_t i = found.first[k];
      const U weights = query.weights(votes, i);
      total = hn::Add(total, weights);
      if constexpr (kMutual)
        hn::StoreU(hn::Add(hn::LoadU(units, back + i), weights), units, back + i);
    }
    sum += sum_of_lanes(total);
  }
  return sum;
}

void scan(const Kernel& kernel, const VoteColumns& votes, const VotePoint* queries,
          std::size_t count, const Blocks& blocks, const Mutual* mutual, std::uint32_t* room,
          std::uint64_t* sums) {
  std::size_t each = 1;
  for (std::size_t r = 0; r < blocks.count; ++r)
    each += (blocks.ranges[r].end - blocks.ranges[r].begin) * (kBlock / hn::Lanes(Floats()));
  // Copies, for what is written cannot be they, as far as the compiler knows.
  const Kernel constants = kernel;
  const VoteColumns columns = votes;
  const auto query = [&](std::size_t k)
                         HWY_ATTR { return Query(constants, queries[std::min(k, count - 1)]); };
  const Query group[kGroup] = {query(0), query(1), query(2), query(3)};
  Found found[kGroup] = {{room, 0}, {room + each, 0}, {room + 2 * each, 0}, {room + 3 * each, 0}};
  if (count == 1)
    find<1>(group, columns, blocks, found);
  else
    find<kGroup>(group, columns, blocks, found);
  for (std::size_t k = 0; k < count; ++k) {
    if (mutual == nullptr) {
      sums[k] = weigh<false>(group[k], columns, found[k], nullptr);
    } else {
      mutual->leaving[k] = std::numeric_limits<float>::infinity();
      sums[k] = weigh<true>(group[k], columns, found[k], mutual->back);
    }
  }
}

std::size_t collect(const Kernel& kernel, const VoteColumns& votes, const VotePoint& point,
                    IndexRange range, std::uint32_t* places, std::uint32_t* weights) {
  const Units units;
  const std::size_t lanes = hn::Lanes(units);
  const Query query(kernel, point);
  const U lane = hn::Iota(units, 0);
  std::size_t count = 0;
  for (std::size_t i = range.begin; i < range.end; i += lanes) {
    if (!query.may_meet(rotations_from(votes, i))) continue;
    const U weight = query.weights(votes, i);
    const auto near =
        hn::And(hn::Ne(weight, hn::Zero(units)), hn::FirstN(units, std::min(lanes, range.end - i)));
    const U place = hn::Add(lane, hn::Set(units, static_cast<std::uint32_t>(i)));
    hn::StoreU(hn::Compress(place, near), units, places + count);
    hn::StoreU(hn::Compress(weight, near), units, weights + count);
    count += hn::CountTrue(units, near);
  }
  return count;
}

}  // namespace posevote::density::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::density {

HWY_EXPORT(scan);
HWY_EXPORT(collect);

void scan_votes(const Kernel& kernel, const VoteColumns& votes, const VotePoint* queries,
                std::size_t count, const Blocks& blocks, const Mutual* mutual, std::uint32_t* found,
                std::uint64_t* sums) {
  HWY_DYNAMIC_DISPATCH(scan)(kernel, votes, queries, count, blocks, mutual, found, sums);
}

std::size_t collect_near(const Kernel& kernel, const VoteColumns& columns, const VotePoint& query,
                         IndexRange range, std::uint32_t* places, std::uint32_t* weights) {
  return HWY_DYNAMIC_DISPATCH(collect)(kernel, columns, query, range, places, weights);
}

}  // namespace posevote::density
#endif
