// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs.
#include "nodes/geometry/plane_moments.hpp"

#include <algorithm>

#include "nodes/geometry/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/geometry/plane_moments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::geometry::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kLanes>;
using F = hn::Vec<Floats>;

PlaneMoments moments(const WeightedPoints& points, const GridRun* runs, std::size_t run_count,
                     const float* center, float radius) {
  const Floats d;
  const F cx = hn::Set(d, center[0]), cy = hn::Set(d, center[1]), cz = hn::Set(d, center[2]);
  const F per_radius = hn::Set(d, 1 / radius), squared_radius = hn::Set(d, radius * radius);
  const F falling = hn::Set(d, 0.999F), full = hn::Set(d, 1);
  constexpr std::size_t kSums = sizeof(PlaneMoments) / sizeof(float);
  HWY_ALIGN float lanes[kSums][kLanes];
  for (std::size_t first = 0; first < kLanes; first += hn::Lanes(d)) {
    F xx = hn::Zero(d), xy = xx, xz = xx, yy = xx, yz = xx, zz = xx, x = xx, y = xx, z = xx;
    F one = xx, count = xx;
    for (std::size_t r = 0; r < run_count; ++r)
      for (std::size_t i = runs[r].begin + first; i < runs[r].end; i += kLanes) {
        const F ox = hn::Sub(hn::LoadU(d, points.x + i), cx);
        const F oy = hn::Sub(hn::LoadU(d, points.y + i), cy);
        const F oz = hn::Sub(hn::LoadU(d, points.z + i), cz);
        const F squared = hn::Add(hn::Add(hn::Mul(ox, ox), hn::Mul(oy, oy)), hn::Mul(oz, oz));
        const auto valid = hn::FirstN(d, std::min(hn::Lanes(d), runs[r].end - i));
        const auto inside = hn::And(hn::Le(squared, squared_radius), valid);
        const F dx = hn::Mul(ox, per_radius), dy = hn::Mul(oy, per_radius);
        const F dz = hn::Mul(oz, per_radius);
        const F distance = hn::Mul(hn::Mul(squared, per_radius), per_radius);
        const F near = hn::Sub(full, hn::Mul(falling, distance));
        const F w = hn::IfThenElseZero(inside, hn::Mul(near, hn::LoadU(d, points.weight + i)));
        const F wx = hn::Mul(w, dx), wy = hn::Mul(w, dy), wz = hn::Mul(w, dz);
        xx = hn::Add(xx, hn::Mul(wx, dx)), xy = hn::Add(xy, hn::Mul(wx, dy));
        xz = hn::Add(xz, hn::Mul(wx, dz)), yy = hn::Add(yy, hn::Mul(wy, dy));
        yz = hn::Add(yz, hn::Mul(wy, dz)), zz = hn::Add(zz, hn::Mul(wz, dz));
        x = hn::Add(x, wx), y = hn::Add(y, wy), z = hn::Add(z, wz);
        one = hn::Add(one, w);
        count = hn::Add(count, hn::IfThenElseZero(inside, full));
      }
    const F sums[kSums] = {xx, xy, xz, yy, yz, zz, x, y, z, one, count};
    for (std::size_t s = 0; s < kSums; ++s) hn::Store(sums[s], d, &lanes[s][first]);
  }
  return {sum_of_lanes(lanes[0]), sum_of_lanes(lanes[1]), sum_of_lanes(lanes[2]),
          sum_of_lanes(lanes[3]), sum_of_lanes(lanes[4]), sum_of_lanes(lanes[5]),
          sum_of_lanes(lanes[6]), sum_of_lanes(lanes[7]), sum_of_lanes(lanes[8]),
          sum_of_lanes(lanes[9]), sum_of_lanes(lanes[10])};
}

}  // namespace posevote::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::geometry {

HWY_EXPORT(moments);

PlaneMoments plane_moments(const WeightedPoints& points, const GridRun* runs, std::size_t run_count,
                           const float* center, float radius) {
  return HWY_DYNAMIC_DISPATCH(moments)(points, runs, run_count, center, radius);
}

}  // namespace posevote::geometry
#endif
