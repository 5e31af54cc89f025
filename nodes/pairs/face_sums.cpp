// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs.
#include "nodes/pairs/face_sums.hpp"

#include <algorithm>

#include "nodes/geometry/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/pairs/face_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::pairs::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using geometry::kLanes, geometry::sum_of_lanes;

using Floats = hn::CappedTag<float, kLanes>;
using F = hn::Vec<Floats>;

HWY_INLINE F dot(F ax, F ay, F az, F bx, F by, F bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

FaceSums sums(const geometry::OrientedColumns& points, const geometry::GridRun* runs,
              std::size_t run_count, const Face& face) {
  const Floats d;
  const F cx = hn::Set(d, face.point[0]), cy = hn::Set(d, face.point[1]),
          cz = hn::Set(d, face.point[2]);
  const F nx = hn::Set(d, face.normal[0]), ny = hn::Set(d, face.normal[1]),
          nz = hn::Set(d, face.normal[2]);
  const F squared_radius = hn::Set(d, face.radius * face.radius);
  const F off_plane = hn::Set(d, face.off_plane), same_normal = hn::Set(d, face.same_normal);
  const F one = hn::Set(d, 1);
  HWY_ALIGN float lanes[4][kLanes];
  for (std::size_t first = 0; first < kLanes; first += hn::Lanes(d)) {
    F x = hn::Zero(d), y = x, z = x, count = x;
    for (std::size_t r = 0; r < run_count; ++r)
      for (std::size_t i = runs[r].begin + first; i < runs[r].end; i += kLanes) {
        const F ox = hn::Sub(hn::LoadU(d, points.x + i), cx);
        const F oy = hn::Sub(hn::LoadU(d, points.y + i), cy);
        const F oz = hn::Sub(hn::LoadU(d, points.z + i), cz);
        const F cosine = dot(hn::LoadU(d, points.nx + i), hn::LoadU(d, points.ny + i),
                             hn::LoadU(d, points.nz + i), nx, ny, nz);
        const auto valid = hn::FirstN(d, std::min(hn::Lanes(d), runs[r].end - i));
        const auto near = hn::And(hn::Le(dot(ox, oy, oz, ox, oy, oz), squared_radius), valid);
        const auto flat = hn::Le(hn::Abs(dot(ox, oy, oz, nx, ny, nz)), off_plane);
        const auto belongs = hn::And(hn::And(near, flat), hn::Gt(cosine, same_normal));
        x = hn::Add(x, hn::IfThenElseZero(belongs, ox));
        y = hn::Add(y, hn::IfThenElseZero(belongs, oy));
        z = hn::Add(z, hn::IfThenElseZero(belongs, oz));
        count = hn::Add(count, hn::IfThenElseZero(belongs, one));
      }
    hn::Store(x, d, &lanes[0][first]);
    hn::Store(y, d, &lanes[1][first]);
    hn::Store(z, d, &lanes[2][first]);
    hn::Store(count, d, &lanes[3][first]);
  }
  return {sum_of_lanes(lanes[0]), sum_of_lanes(lanes[1]), sum_of_lanes(lanes[2]),
          sum_of_lanes(lanes[3])};
}

}  // namespace posevote::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::pairs {

HWY_EXPORT(sums);

FaceSums face_sums(const geometry::OrientedColumns& points, const geometry::GridRun* runs,
                   std::size_t run_count, const Face& face) {
  return HWY_DYNAMIC_DISPATCH(sums)(points, runs, run_count, face);
}

}  // namespace posevote::pairs
#endif
