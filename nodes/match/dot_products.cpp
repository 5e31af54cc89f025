// SPDX-License-Identifier: BSD-3-Clause
// The file is compiled once per instruction set (Highway's foreach_target); the first call picks
// one.
#include "nodes/match/dot_products.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/match/dot_products.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A panel is at least two vectors wide, and 6 x 2 sums are enough to hide the latency of the fused
// multiply-add while they still fit the 16 registers of AVX2.
void multiply(const float* HWY_RESTRICT queries, const float* HWY_RESTRICT panel,
              std::size_t dimension, float* HWY_RESTRICT products, std::size_t stride) {
  const hn::CappedTag<float, kPanelRows / 2> tag;
  const std::size_t lanes = hn::Lanes(tag);
  static_assert(kTileQueries == 6, "the sums below are written out for six queries");
  for (std::size_t r = 0; r < kPanelRows; r += 2 * lanes) {
    auto a0 = hn::Zero(tag), a1 = a0, b0 = a0, b1 = a0, c0 = a0, c1 = a0;
    auto d0 = a0, d1 = a0, e0 = a0, e1 = a0, f0 = a0, f1 = a0;
    for (std::size_t k = 0; k < dimension; ++k) {
      const auto left = hn::Load(tag, panel + k * kPanelRows + r);
      const auto right = hn::Load(tag, panel + k * kPanelRows + r + lanes);
      const float* q = queries + k * kTileQueries;
      const auto add = [&](auto& sum_left, auto& sum_right, float value) HWY_ATTR {
        const auto factor = hn::Set(tag, value);
        sum_left = hn::MulAdd(factor, left, sum_left);
        sum_right = hn::MulAdd(factor, right, sum_right);
      };
      add(a0, a1, q[0]);
      add(b0, b1, q[1]);
      add(c0, c1, q[2]);
      add(d0, d1, q[3]);
      add(e0, e1, q[4]);
      add(f0, f1, q[5]);
    }
    const auto store = [&](std::size_t q, auto sum_left, auto sum_right) HWY_ATTR {
      hn::StoreU(sum_left, tag, products + q * stride + r);
      hn::StoreU(sum_right, tag, products + q * stride + r + lanes);
    };
    store(0, a0, a1);
    store(1, b0, b1);
    store(2, c0, c1);
    store(3, d0, d1);
    store(4, e0, e1);
    store(5, f0, f1);
  }
}

}  // namespace posevote::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote {

HWY_EXPORT(multiply);

void multiply_panel(const float* queries, const float* panel, std::size_t dimension,
                    float* products, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(multiply)(queries, panel, dimension, products, stride);
}

}  // namespace posevote
#endif
