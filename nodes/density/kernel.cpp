// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/kernel.hpp"

#include <array>
#include <cstddef>
#include <numbers>

namespace posevote::density {
namespace {

/// Coefficients of the polynomial that equals f at 0 and at the rest of Chebyshev's nodes of an
/// interval of which 0 is the last node, where it is close to the best that is exact at 0.
template <std::size_t kCount, class F>
std::array<double, kCount> interpolate(const F& f, double end) {
  std::array<double, kCount> nodes{}, newton{}, result{};
  const auto node = [](std::size_t i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(kCount);
    return std::cos(std::numbers::pi * share);
  };
  const double first = node(kCount - 1);
  for (std::size_t i = 0; i < kCount; ++i) {
    nodes[i] = end * (node(i) - first) / (1 - first);
    newton[i] = f(nodes[i]);
  }
  for (std::size_t order = 1; order < kCount; ++order)
    for (std::size_t i = kCount - 1; i >= order; --i)
      newton[i] = (newton[i] - newton[i - 1]) / (nodes[i] - nodes[i - order]);
  for (std::size_t i = kCount; i-- > 0;) {  // result = result (x - nodes[i]) + newton[i]
    for (std::size_t k = kCount - 1; k > 0; --k) result[k] = result[k - 1] - nodes[i] * result[k];
    result[0] = newton[i] - nodes[i] * result[0];
  }
  return result;
}

}  // namespace

Kernel make_kernel(Bandwidth bandwidth) {
  const double sigma_t = static_cast<double>(bandwidth.sigma_t);
  const double sigma_r = static_cast<double>(bandwidth.sigma_r);
  const double chord = 2 * std::sin(sigma_r / 4);
  Kernel kernel{};
  kernel.max_dt2 = bandwidth.sigma_t * bandwidth.sigma_t;
  kernel.max_e2 = static_cast<float>(chord * chord);
  // e2 = |q|^2 + |q'|^2 - 2 <q, q'>, and the norms are 1 up to 1e-5 (is_usable).
  kernel.min_cosine = static_cast<float>(1 - chord * chord / 2 - 5e-5);
  kernel.per_dt2 = static_cast<float>(1 / (sigma_t * sigma_t));
  const auto translation = interpolate<5>([](double share) { return std::exp(-share / 2); }, 1);
  const auto rotation = interpolate<5>(
      [sigma_r](double e2) {
        const double share = 4 * std::asin(std::sqrt(e2) / 2) / sigma_r;
        return std::exp(-share * share / 2);
      },
      chord * chord);
  for (std::size_t i = 0; i < 5; ++i) {
    kernel.translation[i] = static_cast<float>(translation[i] * kWeightUnits);
    kernel.rotation[i] = static_cast<float>(rotation[i]);
  }
  return kernel;
}

}  // namespace posevote::density
