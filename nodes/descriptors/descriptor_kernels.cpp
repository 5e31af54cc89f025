// SPDX-License-Identifier: BSD-3-Clause
// The file is compiled once per instruction set (Highway's foreach_target); the first call picks
// one.
#include "nodes/descriptors/descriptor_kernels.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nodes/descriptors/descriptor_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::descriptors::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(HWY_LANES(float) <= kKernelPadding);

#if HWY_TARGET == HWY_SCALAR

void score_panel(const Pair* queries, const float* factors, const Pair* panel, std::size_t pairs,
                 const float* half_norms, float* scores, std::size_t stride) {
  for (std::size_t q = 0; q < kTileQueries; ++q)
    for (std::size_t r = 0; r < kPanelRows; ++r) {
      std::int32_t sum = 0;
      for (std::size_t k = 0; k < pairs; ++k) {
        const Pair a = queries[k * kTileQueries + q], b = panel[k * kPanelRows + r];
        sum += a.first * b.first + a.second * b.second;
      }
      scores[q * stride + r] = half_norms[r] - factors[q] * static_cast<float>(sum);
    }
}

#else

// A panel is at least two vectors wide, and 4 x 2 sums are enough to hide the latency of an
// addition. With more, compilers run out of the 16 registers of AVX2.
void score_panel(const Pair* HWY_RESTRICT queries, const float* HWY_RESTRICT factors,
                 const Pair* HWY_RESTRICT panel, std::size_t pairs,
                 const float* HWY_RESTRICT half_norms, float* HWY_RESTRICT scores,
                 std::size_t stride) {
  const hn::CappedTag<float, kPanelRows / 2> floats;
  const hn::RebindToSigned<decltype(floats)> sums;
  const hn::Repartition<std::int16_t, decltype(sums)> numbers;
  const std::size_t lanes = hn::Lanes(floats);
  static_assert(kTileQueries == 4, "the sums below are written out for four queries");
  for (std::size_t r = 0; r < kPanelRows; r += 2 * lanes) {
    const auto zero = hn::Zero(sums);
    auto a0 = zero, a1 = zero, b0 = zero, b1 = zero;
    auto c0 = zero, c1 = zero, d0 = zero, d1 = zero;
    // What a processor may keep in a second sum; on x86 there is none.
    auto a2 = zero, a3 = zero, b2 = zero, b3 = zero;
    auto c2 = zero, c3 = zero, d2 = zero, d3 = zero;
    for (std::size_t k = 0; k < pairs; ++k) {
      const auto* row = reinterpret_cast<const std::int16_t*>(panel + k * kPanelRows + r);
      const auto left = hn::Load(numbers, row), right = hn::Load(numbers, row + 2 * lanes);
      const Pair* q = queries + k * kTileQueries;
      const auto add = [&](Pair pair, auto& sum_left, auto& more_left, auto& sum_right,
                           auto& more_right) HWY_ATTR {
        std::int32_t both;
        std::memcpy(&both, &pair, sizeof both);
        const auto factor = hn::BitCast(numbers, hn::Set(sums, both));
        sum_left = hn::ReorderWidenMulAccumulate(sums, factor, left, sum_left, more_left);
        sum_right = hn::ReorderWidenMulAccumulate(sums, factor, right, sum_right, more_right);
      };
      add(q[0], a0, a2, a1, a3);
      add(q[1], b0, b2, b1, b3);
      add(q[2], c0, c2, c1, c3);
      add(q[3], d0, d2, d1, d3);
    }
    const auto half_left = hn::LoadU(floats, half_norms + r);
    const auto half_right = hn::LoadU(floats, half_norms + r + lanes);
    const auto store = [&](std::size_t q, auto left, auto more_left, auto right,
                           auto more_right) HWY_ATTR {
      const auto factor = hn::Set(floats, factors[q]);
      const auto product = [&](auto sum, auto more) HWY_ATTR {
        return hn::ConvertTo(floats, hn::RearrangeToOddPlusEven(sum, more));
      };
      float* out = scores + q * stride + r;
      hn::StoreU(hn::NegMulAdd(factor, product(left, more_left), half_left), floats, out);
      hn::StoreU(hn::NegMulAdd(factor, product(right, more_right), half_right), floats,
                 out + lanes);
    };
    store(0, a0, a2, a1, a3);
    store(1, b0, b2, b1, b3);
    store(2, c0, c2, c1, c3);
    store(3, d0, d2, d1, d3);
  }
}

#endif

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

void score_panel(const Pair* queries, const float* factors, const Pair* panel, std::size_t pairs,
                 const float* half_norms, float* scores, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(score_panel)(queries, factors, panel, pairs, half_norms, scores, stride);
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
