// SPDX-License-Identifier: BSD-3-Clause
#include "tools/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tools/text.hpp"

namespace posevote {

double median(std::vector<double> samples) {
  if (samples.empty()) return 0;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  if (samples.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(samples.begin(), middle));
}

double quantile(std::vector<double> samples, double share) {
  if (samples.empty()) return 0;
  const auto count = static_cast<double>(samples.size());
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(
                                        std::clamp(std::ceil(share * count) - 1, 0.0, count - 1));
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

std::string latency_text(const std::vector<double>& latencies) {
  return format("%.3g s median, %.3g s 95 %%, %.3g s 99 %%", quantile(latencies, 0.5),
                quantile(latencies, 0.95), quantile(latencies, 0.99));
}

}  // namespace posevote
