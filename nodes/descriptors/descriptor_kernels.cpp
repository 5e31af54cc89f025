// SPDX-License-Identifier: BSD-3-Clause
// The file is compiled once per instruction set (Highway's foreach_target); the first call picks
// one.
#include "nodes/descriptors/descriptor_kernels.hpp"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/descriptors/descriptor_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::descriptors::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(HWY_LANES(float) <= kKernelPadding);

// A panel is at least two vectors wide, and 6 x 2 sums are enough to hide the latency of the fused
// multiply-add while they still fit the 16 registers of AVX2.
void score_panel(const float* HWY_RESTRICT queries, const float* HWY_RESTRICT panel,
                 std::size_t dimension, const float* HWY_RESTRICT half_norms,
                 float* HWY_RESTRICT scores, std::size_t stride) {
  const hn::CappedTag<float, kPanelRows / 2> tag;
  const std::size_t lanes = hn::Lanes(tag);
  static_assert(kTileQueries == 6, "the sums below are written out for six queries");
  for (std::size_t r = 0; r < kPanelRows; r += 2 * lanes) {
    auto a0 = hn::LoadU(tag, half_norms + r), a1 = hn::LoadU(tag, half_norms + r + lanes);
    auto b0 = a0, b1 = a1, c0 = a0, c1 = a1, d0 = a0, d1 = a1, e0 = a0, e1 = a1, f0 = a0, f1 = a1;
    for (std::size_t k = 0; k < dimension; ++k) {
      const auto left = hn::Load(tag, panel + k * kPanelRows + r);
      const auto right = hn::Load(tag, panel + k * kPanelRows + r + lanes);
      const float* q = queries + k * kTileQueries;
      const auto subtract = [&](auto& score_left, auto& score_right, float value) HWY_ATTR {
        const auto factor = hn::Set(tag, value);
        score_left = hn::NegMulAdd(factor, left, score_left);
        score_right = hn::NegMulAdd(factor, right, score_right);
      };
      subtract(a0, a1, q[0]);
      subtract(b0, b1, q[1]);
      subtract(c0, c1, q[2]);
      subtract(d0, d1, q[3]);
      subtract(e0, e1, q[4]);
      subtract(f0, f1, q[5]);
    }
    const auto store = [&](std::size_t q, auto score_left, auto score_right) HWY_ATTR {
      hn::StoreU(score_left, tag, scores + q * stride + r);
      hn::StoreU(score_right, tag, scores + q * stride + r + lanes);
    };
    store(0, a0, a1);
    store(1, b0, b1);
    store(2, c0, c1);
    store(3, d0, d1);
    store(4, e0, e1);
    store(5, f0, f1);
  }
}

float second_lowest(const float* HWY_RESTRICT scores, std::size_t count) {
  const hn::ScalableTag<float> tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto infinity = hn::Set(tag, std::numeric_limits<float>::infinity());
  auto best = infinity, second = infinity, sum = hn::Zero(tag);
  const auto look = [&](auto score) HWY_ATTR {
    sum = hn::Add(sum, score);  // not a number, if any is not
    second = hn::Min(second, hn::Max(best, score));
    best = hn::Min(best, score);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) look(hn::LoadU(tag, scores + i));
  if (i < count)
    look(hn::IfThenElse(hn::FirstN(tag, count - i), hn::LoadU(tag, scores + i), infinity));
  HWY_ALIGN float lowest[2][HWY_LANES(float)];
  hn::Store(best, tag, lowest[0]);
  hn::Store(second, tag, lowest[1]);
  float least = std::numeric_limits<float>::infinity(), next = least;
  for (const auto& row : lowest)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      next = std::min(next, std::max(least, row[lane]));
      least = std::min(least, row[lane]);
    }
  const float total = hn::GetLane(hn::SumOfLanes(tag, sum));
  return total == total ? next : total;
}

std::size_t find_low(const float* HWY_RESTRICT scores, std::size_t count, float limit,
                     std::uint32_t* HWY_RESTRICT places) {
  const hn::ScalableTag<float> tag;
  const hn::RebindToUnsigned<decltype(tag)> numbers;
  const std::size_t lanes = hn::Lanes(tag);
  const auto highest = hn::Set(tag, limit);
  std::size_t size = 0;
  const auto look = [&](std::size_t i, auto in_range) HWY_ATTR {
    const auto low = hn::AndNot(hn::Gt(hn::LoadU(tag, scores + i), highest), in_range);
    if (hn::AllFalse(tag, low)) return;
    const auto here = hn::Iota(numbers, static_cast<std::uint32_t>(i));
    size += hn::CompressStore(here, hn::RebindMask(numbers, low), numbers, places + size);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) look(i, hn::FirstN(tag, lanes));
  if (i < count) look(i, hn::FirstN(tag, count - i));
  return size;
}

void multiply(const double* HWY_RESTRICT vectors, const double* HWY_RESTRICT matrix,
              std::size_t dimension, std::size_t columns, double* HWY_RESTRICT products) {
  const hn::CappedTag<double, kColumnStep> tag;
  const std::size_t lanes = hn::Lanes(tag);
  static_assert(kTileVectors == 4, "the sums below are written out for four vectors");
  for (std::size_t j = 0; j < columns; j += lanes) {
    auto a = hn::Zero(tag), b = a, c = a, d = a;
    for (std::size_t k = 0; k < dimension; ++k) {
      const auto factors = hn::LoadU(tag, matrix + k * columns + j);
      const double* v = vectors + k * kTileVectors;
      a = hn::MulAdd(hn::Set(tag, v[0]), factors, a);
      b = hn::MulAdd(hn::Set(tag, v[1]), factors, b);
      c = hn::MulAdd(hn::Set(tag, v[2]), factors, c);
      d = hn::MulAdd(hn::Set(tag, v[3]), factors, d);
    }
    hn::StoreU(a, tag, products + j);
    hn::StoreU(b, tag, products + columns + j);
    hn::StoreU(c, tag, products + 2 * columns + j);
    hn::StoreU(d, tag, products + 3 * columns + j);
  }
}

double squared_distance(const float* HWY_RESTRICT a, const float* HWY_RESTRICT b,
                        std::size_t dimension) {
  constexpr std::size_t kSums = 16;
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> floats;
  const std::size_t lanes = hn::Lanes(tag);
  HWY_ALIGN double sums[kSums];
  const std::size_t whole = dimension / kSums * kSums;
  for (std::size_t j = 0; j < kSums; j += lanes) {
    auto sum = hn::Zero(tag);
    for (std::size_t k = j; k < whole; k += kSums) {
      const auto difference = hn::Sub(hn::PromoteTo(tag, hn::LoadU(floats, a + k)),
                                      hn::PromoteTo(tag, hn::LoadU(floats, b + k)));
      sum = hn::Add(sum, hn::Mul(difference, difference));  // a fused one rounds otherwise
    }
    hn::Store(sum, tag, sums + j);
  }
  for (std::size_t k = whole; k < dimension; ++k) {
    const double difference = static_cast<double>(a[k]) - static_cast<double>(b[k]);
    sums[k - whole] += difference * difference;
  }
  for (std::size_t half = kSums / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

}  // namespace posevote::descriptors::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote::descriptors {

HWY_EXPORT(score_panel);
HWY_EXPORT(second_lowest);
HWY_EXPORT(find_low);
HWY_EXPORT(multiply);
HWY_EXPORT(squared_distance);

void score_panel(const float* queries, const float* panel, std::size_t dimension,
                 const float* half_norms, float* scores, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(score_panel)(queries, panel, dimension, half_norms, scores, stride);
}

float second_lowest(const float* scores, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(second_lowest)(scores, count);
}

std::size_t find_low(const float* scores, std::size_t count, float limit, std::uint32_t* places) {
  return HWY_DYNAMIC_DISPATCH(find_low)(scores, count, limit, places);
}

void multiply(const double* vectors, const double* matrix, std::size_t dimension,
              std::size_t columns, double* products) {
  HWY_DYNAMIC_DISPATCH(multiply)(vectors, matrix, dimension, columns, products);
}

double squared_distance(const float* a, const float* b, std::size_t dimension) {
  return HWY_DYNAMIC_DISPATCH(squared_distance)(a, b, dimension);
}

}  // namespace posevote::descriptors
#endif
