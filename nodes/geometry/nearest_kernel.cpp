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

NearestPoint nearest(const PointGroup* groups, const GridRun* runs, std::size_t run_count,
                     const float* center, float farthest) {
  const Floats d;
  const Indices u;
  const auto cx = hn::Set(d, center[0]), cy = hn::Set(d, center[1]), cz = hn::Set(d, center[2]);
  auto least = hn::Set(d, farthest);
  const auto none = hn::Set(u, NearestPoint{}.index);
  auto index = none;
  for (std::size_t r = 0; r < run_count; ++r)
    for (std::size_t i = runs[r].begin / hn::Lanes(d) * hn::Lanes(d); i < runs[r].end;
         i += hn::Lanes(d)) {
      const PointGroup& group = groups[i / kGroup];
      const std::size_t at = i % kGroup;
      const auto dx = hn::Sub(hn::Load(d, group.x + at), cx);
      const auto dy = hn::Sub(hn::Load(d, group.y + at), cy);
      const auto dz = hn::Sub(hn::Load(d, group.z + at), cz);
      const auto squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      // Without a branch for where none is near: it would be guessed wrong too often.
      const auto near = hn::Le(squared, least);
      const auto here = hn::Load(u, group.index + at);
      const auto first = hn::Or(hn::RebindMask(u, hn::Lt(squared, least)), hn::Lt(here, index));
      const auto better = hn::And(hn::RebindMask(u, near), first);
      least = hn::IfThenElse(hn::RebindMask(d, better), squared, least);
      index = hn::IfThenElse(better, here, index);
    }
  const auto found = hn::Ne(index, none);
  if (hn::AllFalse(u, found)) return {};
  const auto minimum =
      hn::MinOfLanes(d, hn::IfThenElse(hn::RebindMask(d, found), least, hn::Set(d, farthest)));
  const auto first = hn::IfThenElse(hn::RebindMask(u, hn::Eq(least, minimum)), index, none);
  return {hn::GetLane(hn::MinOfLanes(u, first)), hn::GetLane(minimum)};
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
