// SPDX-License-Identifier: BSD-3-Clause
// The file is compiled once per instruction set (Highway's foreach_target); the first call picks
// one.
#include "nodes/pictures/disc_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/pictures/disc_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::pictures::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void draw_disc(const DiscArea& area, std::uint32_t pixel) {
  const hn::CappedTag<float, kDiscPadding> tag;
  const hn::RebindToUnsigned<decltype(tag)> pixel_tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto colour = hn::Set(pixel_tag, pixel);
  const auto steps = hn::Iota(tag, static_cast<float>(area.left));
  const auto squared_radius = hn::Set(tag, area.radius * area.radius);
  const auto slope = hn::Set(tag, area.tilt_x * area.pixel_size);
  // As a function of dx: (a dx + b) dx + c.
  const auto a = hn::Set(tag, 1 + area.tilt_x * area.tilt_x);
  for (int row = 0; row < area.rows; ++row) {
    const auto dy = static_cast<float>(area.top + row);
    const auto b = hn::Set(tag, 2 * area.tilt_x * area.tilt_y * dy);
    const auto c = hn::Set(tag, dy * dy * (1 + area.tilt_y * area.tilt_y));
    const auto start = hn::Set(tag, area.depth + area.tilt_y * dy * area.pixel_size);
    float* depths = area.depths + static_cast<std::size_t>(row) * area.stride;
    std::uint32_t* pixels = area.pixels + static_cast<std::size_t>(row) * area.stride;
    for (int i = 0; i < area.columns; i += lanes) {
      const auto dx = hn::Add(steps, hn::Set(tag, static_cast<float>(i)));
      const auto squared = hn::Add(hn::Mul(hn::Add(hn::Mul(a, dx), b), dx), c);
      const auto depth = hn::Add(start, hn::Mul(slope, dx));
      const auto inside = hn::And(hn::Le(squared, squared_radius),
                                  hn::FirstN(tag, static_cast<std::size_t>(area.columns - i)));
      const auto nearer = hn::And(inside, hn::Lt(depth, hn::LoadU(tag, depths + i)));
      if (hn::AllFalse(tag, nearer)) continue;
      hn::BlendedStore(depth, nearer, tag, depths + i);
      hn::BlendedStore(colour, hn::RebindMask(pixel_tag, nearer), pixel_tag, pixels + i);
    }
  }
}

}  // namespace posevote::pictures::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::pictures {

HWY_EXPORT(draw_disc);

void draw_disc(const DiscArea& area, std::uint32_t pixel) {
  HWY_DYNAMIC_DISPATCH(draw_disc)(area, pixel);
}

}  // namespace posevote::pictures
#endif
