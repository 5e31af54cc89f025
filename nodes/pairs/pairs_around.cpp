// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs. Sums in
// the order in which Eigen adds up three numbers.
#include "nodes/pairs/pairs_around.hpp"

#include <algorithm>

#include "nodes/pairs/pair_limits.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/pairs/pairs_around.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::pairs::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, geometry::kGridPadding>;
using Ints = hn::RebindToSigned<Floats>;
using F = hn::Vec<Floats>;

struct Vector {
  F x, y, z;
};

HWY_INLINE Vector all_lanes(const float (&of)[3]) {
  const Floats d;
  return {hn::Set(d, of[0]), hn::Set(d, of[1]), hn::Set(d, of[2])};
}

HWY_INLINE F dot(const Vector& a, const Vector& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}

/// angle_step
HWY_INLINE hn::Vec<Ints> step_of(F cosine) {
  const Floats d;
  const F steps =
      hn::Mul(hn::Add(cosine, hn::Set(d, 1)), hn::Set(d, static_cast<float>(kCosineSteps)));
  return hn::ConvertTo(Ints(), hn::Min(hn::Max(steps, hn::Zero(d)),
                                       hn::Set(d, static_cast<float>(2 * kCosineSteps))));
}

/// LocalFrame::turn_of, without the last cut to a byte.
HWY_INLINE hn::Vec<Ints> turn_of(F x, F y) {
  const Floats d;
  const auto number = [d](double value) HWY_ATTR { return hn::Set(d, static_cast<float>(value)); };
  const F ax = hn::Abs(x), ay = hn::Abs(y);
  const F wide = hn::Max(ax, ay);
  const F ratio = hn::IfThenElseZero(hn::Gt(wide, hn::Zero(d)), hn::Div(hn::Min(ax, ay), wide));
  const F s = hn::Mul(ratio, ratio);
  F series = hn::Add(hn::Mul(number(kTurnSeries[2]), s), number(kTurnSeries[1]));
  series = hn::Sub(hn::Mul(series, s), number(kTurnSeries[0]));
  F angle = hn::Add(hn::Mul(hn::Mul(series, s), ratio), ratio);
  angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(number(kPi / 2), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(number(kPi), angle), angle);
  angle = hn::IfThenElse(hn::Lt(y, hn::Zero(d)), hn::Sub(number(2 * kPi), angle), angle);
  return hn::ConvertTo(Ints(), hn::Mul(angle, number(128 / kPi)));
}

std::size_t find(const geometry::OrientedColumns& points, const geometry::GridRun* runs,
                 std::size_t run_count, const PairStart& start, const PairColumns& found) {
  const Floats d;
  const Ints n;
  const Vector at = all_lanes(start.point), normal = all_lanes(start.normal);
  const Vector u = all_lanes(start.u), v = all_lanes(start.v);
  const F squared_reach = hn::Set(d, start.reach * start.reach);
  const F in_plane = hn::Set(d, kInPlane), same_normal = hn::Set(d, kSameNormal);
  std::size_t count = 0;
  for (std::size_t r = 0; r < run_count; ++r)
    for (std::size_t i = runs[r].begin; i < runs[r].end; i += hn::Lanes(d)) {
      const Vector offset{hn::Sub(hn::LoadU(d, points.x + i), at.x),
                          hn::Sub(hn::LoadU(d, points.y + i), at.y),
                          hn::Sub(hn::LoadU(d, points.z + i), at.z)};
      // As PointGrid says who is near: added up the other way round.
      const F squared = hn::Add(hn::Add(hn::Mul(offset.x, offset.x), hn::Mul(offset.y, offset.y)),
                                hn::Mul(offset.z, offset.z));
      const auto valid = hn::FirstN(d, std::min<std::size_t>(hn::Lanes(d), runs[r].end - i));
      const auto near = hn::And(hn::Le(squared, squared_reach), valid);
      if (hn::AllFalse(d, near)) continue;
      const Vector other{hn::LoadU(d, points.nx + i), hn::LoadU(d, points.ny + i),
                         hn::LoadU(d, points.nz + i)};
      const F length = hn::Sqrt(dot(offset, offset));
      const F from = hn::Div(dot(normal, offset), length), to = hn::Div(dot(other, offset), length);
      const F between = dot(normal, other);
      const auto flat =
          hn::And(hn::And(hn::Lt(hn::Abs(from), in_plane), hn::Lt(hn::Abs(to), in_plane)),
                  hn::Gt(between, same_normal));
      const auto told = hn::AndNot(flat, hn::Gt(length, hn::Zero(d)));
      const auto kept = start.keeps_all ? near : hn::And(near, told);
      const auto put = [&](auto value, auto* column) HWY_ATTR {
        const hn::DFromV<decltype(value)> tag;
        hn::StoreU(hn::Compress(value, hn::RebindMask(tag, kept)), tag, column + count);
      };
      put(length, found.length);
      put(hn::IfThenElse(hn::RebindMask(n, told), step_of(from), hn::Set(n, -1)), found.from);
      put(step_of(to), found.to);
      put(step_of(between), found.between);
      put(turn_of(dot(u, offset), dot(v, offset)), found.turn);
      put(hn::Add(hn::Iota(n, 0), hn::Set(n, static_cast<std::int32_t>(i))), found.position);
      count += hn::CountTrue(d, kept);
    }
  return count;
}

}  // namespace posevote::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::pairs {

HWY_EXPORT(find);

std::size_t find_pairs(const geometry::OrientedColumns& points, const geometry::GridRun* runs,
                       std::size_t run_count, const PairStart& start, const PairColumns& found) {
  return HWY_DYNAMIC_DISPATCH(find)(points, runs, run_count, start, found);
}

}  // namespace posevote::pairs
#endif
