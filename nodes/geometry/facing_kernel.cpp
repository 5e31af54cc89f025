// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs.
#include "nodes/geometry/facing_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/geometry/facing_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::geometry::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Floats>;

/// Added up as Eigen does it.
HWY_INLINE Vector dot(Vector ax, Vector ay, Vector az, Vector bx, Vector by, Vector bz) {
  return hn::Add(hn::Mul(ax, bx), hn::Add(hn::Mul(ay, by), hn::Mul(az, bz)));
}

void face(const Posing& posing, PointBatch& points, std::size_t count) {
  const Floats d;
  const auto along = [&](int axis, int column)
                         HWY_ATTR { return hn::Set(d, posing.rotation[column][axis]); };
  const auto move = [&](int axis, Vector x, Vector y, Vector z) HWY_ATTR {
    const auto xy = hn::Add(hn::Mul(along(axis, 0), x), hn::Mul(along(axis, 1), y));
    return hn::Add(hn::Add(xy, hn::Mul(along(axis, 2), z)), hn::Set(d, posing.translation[axis]));
  };
  const auto turn = [&](int axis, Vector x, Vector y, Vector z) HWY_ATTR {
    return dot(along(axis, 0), along(axis, 1), along(axis, 2), x, y, z);
  };
  const auto view = [&](int axis) HWY_ATTR { return hn::Set(d, posing.viewpoint[axis]); };
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto mx = hn::Load(d, points.x + i), my = hn::Load(d, points.y + i),
               mz = hn::Load(d, points.z + i);
    const auto x = move(0, mx, my, mz), y = move(1, mx, my, mz), z = move(2, mx, my, mz);
    const auto kx = hn::Load(d, points.nx + i), ky = hn::Load(d, points.ny + i),
               kz = hn::Load(d, points.nz + i);
    const auto nx = turn(0, kx, ky, kz), ny = turn(1, kx, ky, kz), nz = turn(2, kx, ky, kz);
    hn::Store(x, d, points.x + i), hn::Store(y, d, points.y + i), hn::Store(z, d, points.z + i);
    hn::Store(nx, d, points.nx + i), hn::Store(ny, d, points.ny + i);
    hn::Store(nz, d, points.nz + i);
    if (!posing.single_view) {
      const auto has_normal = hn::Gt(dot(nx, ny, nz, nx, ny, nz), hn::Zero(d));
      hn::Store(hn::IfThenElseZero(has_normal, hn::Set(d, 1.0F)), d, points.cosine + i);
      continue;
    }
    const auto wx = hn::Sub(view(0), x), wy = hn::Sub(view(1), y), wz = hn::Sub(view(2), z);
    const auto toward = dot(nx, ny, nz, wx, wy, wz);
    const auto cosine = hn::Div(toward, hn::Sqrt(dot(wx, wy, wz, wx, wy, wz)));
    const auto faces =
        hn::And(hn::Gt(toward, hn::Zero(d)), hn::Gt(cosine, hn::Set(d, posing.least_cosine)));
    hn::Store(hn::IfThenElseZero(faces, cosine), d, points.cosine + i);
  }
}

}  // namespace posevote::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::geometry {

HWY_EXPORT(face);

void pose_and_face(const Posing& posing, PointBatch& points, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(face)(posing, points, count);
}

}  // namespace posevote::geometry
#endif
