// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plot/line_chart.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace posevote::line_chart_test {

using namespace posevote::plot;
using Catch::Contains;

TEST_CASE("ticks are round and within the range", "[plot]") {
  CHECK(ticks(0, 1, false) == std::vector<double>{0, 0.2, 0.4, 0.2 * 3, 0.8, 1});
  CHECK(ticks(3, 97, false) == std::vector<double>{20, 40, 60, 80});
  CHECK(ticks(0.5, 2000, true) == std::vector<double>{1, 10, 100, 1000});
  CHECK(ticks(1, 30, true) == std::vector<double>{1, 2, 5, 10, 20});
  CHECK(ticks(1, 2, true).size() == 6);  // as good as linear
  CHECK(ticks(1, 1, false).empty());
  CHECK(ticks(0, std::numeric_limits<double>::quiet_NaN(), false).empty());
}

TEST_CASE("a chart draws its series, escapes text and breaks at gaps", "[plot]") {
  Chart chart;
  chart.title = "a < b & \"c\"";
  chart.series = {{"ours", {0, 1, 2, 3}, {0, 1, std::nan(""), 1}}, {"theirs", {0, 3}, {1, 0}}};
  const std::string svg = to_svg(chart);
  CHECK_THAT(
      svg, Contains("a &lt; b &amp; &quot;c&quot;") && Contains(">ours<") && Contains(">theirs<"));
  // From the lower left corner to the upper edge, then anew at the upper right corner.
  CHECK_THAT(svg, Contains("d=\"M62.0 328.0L188.7 36.0M442.0 36.0\""));
}

TEST_CASE("charts side by side, empty ones and odd values", "[plot]") {
  Chart log;
  log.log_y = true;
  log.series = {{"x", {1, 2, 3}, {0, 10, 1000}}};
  const std::string svg = to_svg(std::vector<Chart>{log, Chart{}});
  CHECK_THAT(svg, Contains("width=\"920\"") && Contains("translate(460 0)"));
  CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
}

}  // namespace posevote::line_chart_test
