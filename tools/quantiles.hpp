// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace posevote {

/// The one in the middle, or the mean of the two there; 0 of nothing.
double median(std::vector<double> samples);

/// The least sample of which it is true that `share` of them are no larger; 0 of nothing.
double quantile(std::vector<double> samples, double share);

/// "0.12 s median, 0.18 s 95 %, 0.24 s 99 %", of seconds.
std::string latency_text(const std::vector<double>& latencies);

}  // namespace posevote
