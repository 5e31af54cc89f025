// SPDX-License-Identifier: BSD-3-Clause
// Compiled once per instruction set by Highway, as the kernels are.
#include "tests/bench/machine_rate.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/machine_rate.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace posevote::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using F = hn::Vec<Floats>;

double arithmetic(std::size_t rounds, float* sink) {
  const Floats d;
  const F factor = hn::Set(d, 0.999F), term = hn::Set(d, 0.001F);
  F a = term, b = a, c = a, e = a, f = a, g = a, h = a, i = a;
  const auto step = [&](F& x) HWY_ATTR { x = hn::Add(hn::Mul(x, factor), term); };
  for (std::size_t round = 0; round < rounds; ++round)
    step(a), step(b), step(c), step(e), step(f), step(g), step(h), step(i);
  const F sum =
      hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(hn::Add(f, g), hn::Add(h, i)));
  hn::StoreU(sum, d, sink);
  return 16.0 * static_cast<double>(rounds) * static_cast<double>(hn::Lanes(d));
}

float read(const float* values, std::size_t count) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  F a = hn::Zero(d), b = a, c = a, e = a;
  for (std::size_t i = 0; i + 4 * lanes <= count; i += 4 * lanes) {
    a = hn::Add(a, hn::LoadU(d, values + i));
    b = hn::Add(b, hn::LoadU(d, values + i + lanes));
    c = hn::Add(c, hn::LoadU(d, values + i + 2 * lanes));
    e = hn::Add(e, hn::LoadU(d, values + i + 3 * lanes));
  }
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(a, b), hn::Add(c, e))));
}

}  // namespace posevote::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posevote {

HWY_EXPORT(arithmetic);
HWY_EXPORT(read);

double do_arithmetic(std::size_t rounds, float* sink) {
  return HWY_DYNAMIC_DISPATCH(arithmetic)(rounds, sink);
}

float read_all(const float* values, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(read)(values, count);
}

}  // namespace posevote
#endif
