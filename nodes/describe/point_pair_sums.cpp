// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway; the best is chosen when the program runs. Raw
// pointers only: a type shared with code built for another instruction set must not be instantiated
// here.
#include "nodes/describe/point_pair_sums.hpp"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/describe/point_pair_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::describe::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, geometry::kGridPadding>;
using Ints = hn::RebindToSigned<Floats>;
using F = hn::Vec<Floats>;

constexpr std::size_t kBlock = 64;                              // pairs that are weighed together
constexpr std::size_t kRoom = kBlock + geometry::kGridPadding;  // Compress may write a whole vector

/// The angle of a cosine, over pi: Abramowitz and Stegun 4.4.45, at most 7e-5 rad off. The cosine
/// may have rounded beyond one.
HWY_INLINE F angle_over_pi(F cosine) {
  const Floats d;
  const F one = hn::Set(d, 1);
  const F c = hn::Min(hn::Abs(cosine), one);
  F polynomial = hn::Sub(hn::Set(d, 0.0742610F), hn::Mul(c, hn::Set(d, 0.0187293F)));
  polynomial = hn::Add(hn::Set(d, -0.2121144F), hn::Mul(c, polynomial));
  polynomial = hn::Add(hn::Set(d, 1.5707288F), hn::Mul(c, polynomial));
  const F acute = hn::Mul(hn::Sqrt(hn::Sub(one, c)), polynomial);
  const F share = hn::Mul(hn::Set(d, 0.318309886F), acute);
  return hn::IfThenElse(hn::Lt(cosine, hn::Zero(d)), hn::Sub(one, share), share);
}

HWY_INLINE F dot(F ax, F ay, F az, F bx, F by, F bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

/// Collects neighbours until a block is full, then adds their pairs.
class Pairs {
 public:
  HWY_INLINE Pairs(const PairSource& source, PointPairSums& pairs) : pairs_(pairs) {
    const Floats d;
    px_ = hn::Set(d, source.point[0]);
    py_ = hn::Set(d, source.point[1]);
    pz_ = hn::Set(d, source.point[2]);
    nx_ = hn::Set(d, source.normal[0]);
    ny_ = hn::Set(d, source.normal[1]);
    nz_ = hn::Set(d, source.normal[2]);
    squared_radius_ = hn::Set(d, source.radius * source.radius);
    min_facing_ = hn::Set(d, source.min_facing);
    bins_per_metre_ = hn::Set(d, PointPairSums::kDistanceBins / source.radius);
  }

  /// Adds the neighbours among the points from i on, where `valid`.
  HWY_INLINE void add(const geometry::OrientedColumns& cloud, std::size_t i,
                      hn::Mask<Floats> valid) {
    const Floats d;
    const F x = hn::Sub(hn::LoadU(d, cloud.x + i), px_);
    const F y = hn::Sub(hn::LoadU(d, cloud.y + i), py_);
    const F z = hn::Sub(hn::LoadU(d, cloud.z + i), pz_);
    const F squared = dot(x, y, z, x, y, z);
    const auto near = hn::And(hn::Le(squared, squared_radius_), hn::Gt(squared, hn::Zero(d)));
    const F other_x = hn::LoadU(d, cloud.nx + i), other_y = hn::LoadU(d, cloud.ny + i);
    const F other_z = hn::LoadU(d, cloud.nz + i);
    const auto facing = hn::Ge(dot(other_x, other_y, other_z, nx_, ny_, nz_), min_facing_);
    const auto chosen = hn::And(hn::And(near, facing), valid);
    hn::StoreU(hn::Compress(x, chosen), d, x_ + filled_);
    hn::StoreU(hn::Compress(y, chosen), d, y_ + filled_);
    hn::StoreU(hn::Compress(z, chosen), d, z_ + filled_);
    hn::StoreU(hn::Compress(other_x, chosen), d, other_x_ + filled_);
    hn::StoreU(hn::Compress(other_y, chosen), d, other_y_ + filled_);
    hn::StoreU(hn::Compress(other_z, chosen), d, other_z_ + filled_);
    filled_ += hn::CountTrue(d, chosen);
    if (filled_ > kBlock) flush();
  }

  HWY_INLINE int finish() {
    flush();
    return count_;
  }

 private:
  void flush() {
    const Floats d;
    for (std::size_t i = 0; i < filled_; i += hn::Lanes(d)) weigh(i);
    scatter();
    count_ += static_cast<int>(filled_);
    filled_ = 0;
  }

  /// Bins and weights of the pairs from i on; what lies behind the last is weighed, not used.
  HWY_INLINE void weigh(std::size_t i) {
    const Floats d;
    const F x = hn::Load(d, x_ + i), y = hn::Load(d, y_ + i), z = hn::Load(d, z_ + i);
    const F ox = hn::Load(d, other_x_ + i), oy = hn::Load(d, other_y_ + i);
    const F oz = hn::Load(d, other_z_ + i);
    const F distance = hn::Max(hn::Sqrt(dot(x, y, z, x, y, z)), hn::Set(d, 1e-20F));
    const F cos_first = hn::Div(dot(x, y, z, nx_, ny_, nz_), distance);
    const F cos_second = hn::Div(dot(x, y, z, ox, oy, oz), distance);
    const F cos_normals = dot(ox, oy, oz, nx_, ny_, nz_);
    // The second normal against (d x n) / |d x n|, the direction around the first normal.
    const F triple =
        dot(hn::Sub(hn::Mul(y, nz_), hn::Mul(z, ny_)), hn::Sub(hn::Mul(z, nx_), hn::Mul(x, nz_)),
            hn::Sub(hn::Mul(x, ny_), hn::Mul(y, nx_)), ox, oy, oz);
    const F squared_sine = hn::Sub(hn::Set(d, 1), hn::Mul(cos_first, cos_first));
    const F sine = hn::Sqrt(hn::Max(squared_sine, hn::Set(d, 1e-12F)));
    const F row_position = hn::Add(hn::Mul(distance, bins_per_metre_), hn::Set(d, 0.5F));
    const auto row = floor_at_most(row_position, PointPairSums::kDistanceBins);
    const F far = hn::Sub(row_position, hn::ConvertTo(d, row));
    place(0, i, row, far, angle_over_pi(cos_first));
    place(1, i, row, far, angle_over_pi(cos_second));
    place(2, i, row, far, angle_over_pi(cos_normals));
    place(3, i, row, far, angle_over_pi(hn::Div(triple, hn::Mul(distance, sine))));
  }

  HWY_INLINE hn::Vec<Ints> floor_at_most(F position, int most) const {
    return hn::Min(hn::ConvertTo(Ints(), position), hn::Set(Ints(), most));
  }

  HWY_INLINE void place(int angle, std::size_t i, hn::Vec<Ints> row, F far, F share) {
    const Floats d;
    const Ints n;
    const F one = hn::Set(d, 1);
    const F position =
        hn::Add(hn::Mul(share, hn::Set(d, PointPairSums::kAngleBins)), hn::Set(d, 0.5F));
    const auto column = floor_at_most(position, PointPairSums::kAngleBins);
    const F up = hn::Sub(position, hn::ConvertTo(d, column));
    const F near = hn::Sub(one, far), down = hn::Sub(one, up);
    constexpr int kColumns = PointPairSums::kAngleBins + 1, kAngles = PointPairSums::kAngles;
    const auto entry = hn::Add(hn::Mul(row, hn::Set(n, kAngles * kColumns)),
                               hn::Add(column, hn::Set(n, angle * kColumns)));
    hn::Store(entry, n, entry_[angle] + i);
    hn::StoreInterleaved4(hn::Mul(near, down), hn::Mul(near, up), hn::Mul(far, down),
                          hn::Mul(far, up), d, weight_[angle] + 4 * i);
  }

  HWY_INLINE void scatter() {
    const hn::CappedTag<float, 4> four;
    float* sums = &pairs_.sums[0][0][0][0];
    for (std::size_t i = 0; i < filled_; ++i)
      for (int angle = 0; angle < PointPairSums::kAngles; ++angle) {
        float* entry = sums + 4 * static_cast<std::size_t>(entry_[angle][i]);
        const float* weight = weight_[angle] + 4 * i;
        for (std::size_t k = 0; k < 4; k += hn::Lanes(four)) {
          const auto sum = hn::Add(hn::LoadU(four, entry + k), hn::Load(four, weight + k));
          hn::StoreU(sum, four, entry + k);
        }
      }
  }

  PointPairSums& pairs_;
  F px_, py_, pz_, nx_, ny_, nz_, squared_radius_, min_facing_, bins_per_metre_;
  std::size_t filled_ = 0;
  int count_ = 0;
  HWY_ALIGN float x_[kRoom], y_[kRoom], z_[kRoom];
  HWY_ALIGN float other_x_[kRoom], other_y_[kRoom], other_z_[kRoom];
  HWY_ALIGN std::int32_t entry_[PointPairSums::kAngles][kRoom];
  HWY_ALIGN float weight_[PointPairSums::kAngles][4 * kRoom];
};

int add_pairs(const geometry::OrientedColumns& cloud, const geometry::GridRun* runs,
              std::size_t run_count, const PairSource& source, PointPairSums& sums) {
  const Floats d;
  Pairs pairs(source, sums);
  for (std::size_t r = 0; r < run_count; ++r)
    for (std::size_t i = runs[r].begin; i < runs[r].end; i += hn::Lanes(d))
      pairs.add(cloud, i, hn::FirstN(d, std::min(hn::Lanes(d), runs[r].end - i)));
  return pairs.finish();
}

}  // namespace posevote::describe::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::describe {

HWY_EXPORT(add_pairs);

int add_point_pairs(const geometry::OrientedColumns& cloud, const geometry::GridRun* runs,
                    std::size_t run_count, const PairSource& source, PointPairSums& pairs) {
  return HWY_DYNAMIC_DISPATCH(add_pairs)(cloud, runs, run_count, source, pairs);
}

}  // namespace posevote::describe
#endif
