// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway, as scan_votes.cpp.
#include <algorithm>

#include "nodes/density/rotation_cells.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/density/encode_rotations.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::density::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Codes = hn::RebindToUnsigned<Floats>;
using F = hn::Vec<Floats>;
using C = hn::Vec<Codes>;

/// Levels of one coordinate of a chart: warp and level of rotation_cells.cpp.
HWY_INLINE C level(F numerator, F denominator) {
  const Floats d;
  const hn::RebindToSigned<Floats> whole;
  const F u = hn::Div(numerator, denominator);
  const F v = hn::Div(hn::Mul(u, hn::Sub(hn::Set(d, 4), hn::Abs(u))), hn::Set(d, 3));
  const F level = hn::Mul(hn::Add(v, hn::Set(d, 1)), hn::Set(d, kLevels / 2));
  return hn::BitCast(
      Codes(), hn::ConvertTo(whole, hn::Min(hn::Max(level, hn::Zero(d)), hn::Set(d, kLevels - 1))));
}

HWY_INLINE C encode_vector(const float* const (&quaternions)[4], std::size_t i) {
  const Floats d;
  const Codes u;
  F q[4];
  for (std::size_t k = 0; k < 4; ++k) q[k] = hn::LoadU(d, quaternions[k] + i);
  F largest = q[0], a = q[1], b = q[2], c = q[3];
  C chart = hn::Zero(u);
  for (std::uint32_t k = 1; k < 4; ++k) {
    const auto larger = hn::Gt(hn::Abs(q[k]), hn::Abs(largest));
    largest = hn::IfThenElse(larger, q[k], largest);
    a = hn::IfThenElse(larger, q[(k + 1) % 4], a);
    b = hn::IfThenElse(larger, q[(k + 2) % 4], b);
    c = hn::IfThenElse(larger, q[(k + 3) % 4], c);
    chart = hn::IfThenElse(hn::RebindMask(u, larger), hn::Set(u, k), chart);
  }
  const C above = hn::Or(hn::ShiftLeft<24>(chart), hn::ShiftLeft<16>(level(a, largest)));
  const C below = hn::Or(hn::ShiftLeft<8>(level(b, largest)), level(c, largest));
  return hn::Or(above, below);
}

void encode(const float* const (&quaternions)[4], std::size_t count, std::uint32_t* codes) {
  const Codes u;
  const std::size_t lanes = hn::Lanes(u);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(encode_vector(quaternions, i), u, codes + i);
  if (i == count) return;
  float rest[4][HWY_LANES(float)] = {};
  std::uint32_t last[HWY_LANES(float)];
  for (std::size_t k = 0; k < 4; ++k)
    std::copy(quaternions[k] + i, quaternions[k] + count, rest[k]);
  const float* const of_rest[4] = {rest[0], rest[1], rest[2], rest[3]};
  hn::StoreU(encode_vector(of_rest, 0), u, last);
  std::copy(last, last + (count - i), codes + i);
}

}  // namespace posevote::density::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::density {

HWY_EXPORT(encode);

void encode_rotations(const std::array<const float*, 4>& quaternions, std::size_t count,
                      RotationCode* codes) {
  const float* const each[4] = {quaternions[0], quaternions[1], quaternions[2], quaternions[3]};
  HWY_DYNAMIC_DISPATCH(encode)(each, count, codes);
}

}  // namespace posevote::density
#endif
