// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs.
#include "nodes/geometry/nearest_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/geometry/nearest_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::geometry::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kGroup>;
using Indices = hn::RebindToUnsigned<Floats>;

/// Calls with the squared distances and the numbers of so many points as there are lanes, until all
/// of the runs were seen.
template <class See>
HWY_INLINE void for_each(const PointGroup* groups, const GridRun* runs, std::size_t run_count,
                         const float* center, See see) {
  const Floats d;
  const auto cx = hn::Set(d, center[0]), cy = hn::Set(d, center[1]), cz = hn::Set(d, center[2]);
  for (std::size_t r = 0; r < run_count; ++r)
    for (std::size_t i = runs[r].begin / hn::Lanes(d) * hn::Lanes(d); i < runs[r].end;
         i += hn::Lanes(d)) {
      const PointGroup& group = groups[i / kGroup];
      const std::size_t at = i % kGroup;
      const auto dx = hn::Sub(hn::Load(d, group.x + at), cx);
      const auto dy = hn::Sub(hn::Load(d, group.y + at), cy);
      const auto dz = hn::Sub(hn::Load(d, group.z + at), cz);
      see(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)),
          hn::Load(Indices(), group.index + at));
    }
}

/// The smallest index of those at this squared distance.
std::uint32_t first_at(const PointGroup* groups, const GridRun* runs, std::size_t run_count,
                       const float* center, float squared) {
  const Floats d;
  auto first = hn::Set(Indices(), NearestPoint::kNone);
  for_each(groups, runs, run_count, center, [&](auto there, auto index) HWY_ATTR {
    const auto equal = hn::RebindMask(Indices(), hn::Eq(there, hn::Set(d, squared)));
    first = hn::IfThenElse(equal, hn::Min(first, index), first);
  });
  return hn::GetLane(hn::MinOfLanes(Indices(), first));
}

NearestPoint nearest(const PointGroup* groups, const GridRun* runs, std::size_t run_count,
                     const float* center, float farthest) {
  const Floats d;
  auto least = hn::Set(d, farthest);
  auto nearest = hn::Set(Indices(), NearestPoint::kNone);
  auto ties = hn::Lt(least, least);  // none
  // No branch for where none is near, it would be guessed wrong too often. Ties, which are rare, are
  // only noticed, so that what comes next waits for a minimum, no more.
  for_each(groups, runs, run_count, center, [&](auto squared, auto index) HWY_ATTR {
    const auto nearer = hn::Lt(squared, least);
    const auto other = hn::RebindMask(d, hn::Ne(index, nearest));
    ties = hn::Or(ties, hn::And(hn::Eq(squared, least), other));
    least = hn::Min(squared, least);
    nearest = hn::IfThenElse(hn::RebindMask(Indices(), nearer), index, nearest);
  });
  const bool none =
      hn::AllTrue(Indices(), hn::Eq(nearest, hn::Set(Indices(), NearestPoint::kNone)));
  if (none && hn::AllFalse(d, ties)) return {};
  const auto minimum = hn::MinOfLanes(d, least);
  const float squared = hn::GetLane(minimum);
  const auto at_minimum = hn::Eq(least, minimum);
  if (!hn::AllFalse(d, ties) || hn::CountTrue(d, at_minimum) > 1)
    return {first_at(groups, runs, run_count, center, squared), squared};
  const auto lane = static_cast<std::size_t>(hn::FindFirstTrue(d, at_minimum));
  return {hn::ExtractLane(nearest, lane), squared};
}

}  // namespace posevote::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::geometry {

HWY_EXPORT(nearest);

NearestPoint nearest_in_runs(const PointGroup* groups, const GridRun* runs, std::size_t run_count,
                             const float* center, float farthest) {
  return HWY_DYNAMIC_DISPATCH(nearest)(groups, runs, run_count, center, farthest);
}

}  // namespace posevote::geometry
#endif
