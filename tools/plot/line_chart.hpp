// SPDX-License-Identifier: BSD-3-Clause
// Line charts as SVG text.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace posevote::plot {

struct Series {
  std::string name;
  std::vector<double> x, y;  ///< as many of each; what is not finite interrupts the line
};

using Range = std::optional<std::pair<double, double>>;

struct Chart {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  Range x_range, y_range;             ///< else what the series span
  bool log_x = false, log_y = false;  ///< values up to 0 are left out
};

std::string to_svg(const Chart& chart);

/// Side by side, in the order given.
std::string to_svg(const std::vector<Chart>& charts);

/// Round numbers from low to high, some five of them; powers of ten on a logarithmic axis.
std::vector<double> ticks(double low, double high, bool logarithmic);

}  // namespace posevote::plot
