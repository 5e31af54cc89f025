// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plot/line_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/text.hpp"

namespace posevote::plot {
namespace {

constexpr double kWidth = 460, kHeight = 380, kLeft = 62, kRight = 18, kTop = 36, kBottom = 52;
// Okabe and Ito's colours, which the colour-blind can tell apart; dark ones first.
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                              "#e69f00", "#56b4e9", "#000000", "#888888"};

/// Values to a length in pixels.
class Axis {
 public:
  Axis(const Chart& chart, bool is_x)
      : logarithmic_(is_x ? chart.log_x : chart.log_y),
        length_(is_x ? kWidth - kLeft - kRight : kHeight - kTop - kBottom) {
    span(chart, is_x);
    if (!usable(low_) || !usable(high_) || low_ > high_) low_ = logarithmic_ ? 1 : 0, high_ = 10;
    if (low_ == high_) {
      high_ = logarithmic_ ? high_ * 10 : high_ + std::max(1.0, std::abs(high_));
    }
  }
  bool usable(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  double place(double value) const {
    if (logarithmic_) return length_ * std::log(value / low_) / std::log(high_ / low_);
    return length_ * (value - low_) / (high_ - low_);
  }
  std::vector<double> marks() const { return ticks(low_, high_, logarithmic_); }

 private:
  /// What the chart asks for, else what its series span.
  void span(const Chart& chart, bool is_x) {
    if (const Range& range = is_x ? chart.x_range : chart.y_range) {
      low_ = range->first, high_ = range->second;
      return;
    }
    for (const Series& series : chart.series)
      for (const double value : is_x ? series.x : series.y) include(value);
  }
  void include(double value) {
    if (!usable(value)) return;
    low_ = std::min(low_, value), high_ = std::max(high_, value);
  }
  bool logarithmic_;
  double length_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

std::string words(double x, double y, const char* anchor, const std::string& text,
                  const char* more = "") {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", x, y, anchor, more) +
         escape_markup(text) + "</text>\n";
}

std::string frame(const Chart& chart, const Axis& x, const Axis& y) {
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  std::string svg;
  for (const double mark : x.marks()) {
    const double at = kLeft + x.place(mark);
    svg += format("<path d=\"M%.1f %.1fV%.1f\" stroke=\"#ddd\"/>\n", at, kTop, bottom);
    svg += words(at, bottom + 16, "middle", format("%.6g", mark));
  }
  for (const double mark : y.marks()) {
    const double at = bottom - y.place(mark);
    svg += format("<path d=\"M%.1f %.1fH%.1f\" stroke=\"#ddd\"/>\n", kLeft, at, right);
    svg += words(kLeft - 6, at + 4, "end", format("%.6g", mark));
  }
  svg += format(
      "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
      "stroke=\"#333\"/>\n",
      kLeft, kTop, right - kLeft, bottom - kTop);
  svg += words((kLeft + right) / 2, kTop - 14, "middle", chart.title, " font-weight=\"bold\"");
  svg += words((kLeft + right) / 2, bottom + 38, "middle", chart.x_label);
  const double middle = (kTop + bottom) / 2;
  return svg + words(16, middle, "middle", chart.y_label,
                     format(" transform=\"rotate(-90 16 %.1f)\"", middle).c_str());
}

std::string marker(std::size_t kind, double x, double y, const char* colour) {
  if (kind % 3 == 0)
    return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.6\" fill=\"%s\"/>\n", x, y, colour);
  if (kind % 3 == 1)
    return format("<rect x=\"%.1f\" y=\"%.1f\" width=\"5\" height=\"5\" fill=\"%s\"/>\n", x - 2.5,
                  y - 2.5, colour);
  return format("<path d=\"M%.1f %.1fl3 5.4h-6z\" fill=\"%s\"/>\n", x, y - 3, colour);
}

std::string line(const Series& series, std::size_t kind, const Axis& x, const Axis& y) {
  const char* colour = kColours[kind % kColours.size()];
  std::string path, markers;
  bool pen = false;
  const std::size_t count = std::min(series.x.size(), series.y.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool shown = x.usable(series.x[i]) && y.usable(series.y[i]);
    if (shown) {
      const double u = kLeft + x.place(series.x[i]), v = kHeight - kBottom - y.place(series.y[i]);
      path += format("%c%.1f %.1f", pen ? 'L' : 'M', u, v);
      if (count <= 40) markers += marker(kind, u, v, colour);
    }
    pen = shown;
  }
  if (path.empty()) return "";
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour +
         "\" stroke-width=\"1.6\"/>\n" + markers;
}

std::string legend(const Chart& chart) {
  std::string svg;
  double y = kTop + 16;
  for (std::size_t i = 0; i < chart.series.size(); ++i, y += 15) {
    const char* colour = kColours[i % kColours.size()];
    svg += format("<path d=\"M%.1f %.1fh18\" stroke=\"%s\" stroke-width=\"2\"/>\n", kLeft + 8,
                  y - 4, colour);
    svg += marker(i, kLeft + 17, y - 4, colour);
    svg += words(kLeft + 31, y, "start", chart.series[i].name);
  }
  return svg;
}

std::string body(const Chart& chart, std::size_t place) {
  const Axis x(chart, true), y(chart, false);
  // Lines end at the frame, whatever range the chart was given.
  std::string svg = format(
      "<clipPath id=\"frame%zu\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" "
      "height=\"%.1f\"/></clipPath>\n",
      place, kLeft - 4, kTop - 4, kWidth - kLeft - kRight + 8, kHeight - kTop - kBottom + 8);
  svg += frame(chart, x, y) + format("<g clip-path=\"url(#frame%zu)\">\n", place);
  for (std::size_t i = 0; i < chart.series.size(); ++i) svg += line(chart.series[i], i, x, y);
  return svg + "</g>\n" + legend(chart);
}

/// These multiples of the powers of ten, of many powers only some.
std::vector<double> decades(double low, double high, const std::vector<double>& multiples) {
  std::vector<double> marks;
  const double first = std::floor(std::log10(low)), last = std::log10(high) + 1e-9;
  const double step = std::max(1.0, std::ceil((last - first) / 8));
  for (int i = 0; first + i * step <= last; ++i)
    for (const double multiple : multiples)
      if (const double mark = multiple * std::pow(10.0, first + i * step);
          mark >= low * (1 - 1e-9) && mark <= high * (1 + 1e-9))
        marks.push_back(mark);
  return marks;
}

}  // namespace

std::vector<double> ticks(double low, double high, bool logarithmic) {
  std::vector<double> marks;
  if (!std::isfinite(low) || !std::isfinite(high) || !(high > low)) return marks;
  if (logarithmic) {
    marks = decades(low, high, {1});
    // Less than two decades need marks between; less than half a decade is nearly linear.
    if (marks.size() < 3) marks = decades(low, high, {1, 2, 5});
    return marks.size() < 3 ? ticks(low, high, false) : marks;
  }
  const double rough = (high - low) / 5, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double ratio = rough / power;
  const double step = power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; i < 12 && (first + i) * step <= high + 1e-9 * step; ++i)
    marks.push_back((first + i) * step);
  return marks;
}

std::string to_svg(const std::vector<Chart>& charts) {
  std::string svg = format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" "
      "fill=\"white\"/>\n",
      kWidth * static_cast<double>(std::max<std::size_t>(1, charts.size())), kHeight);
  for (std::size_t i = 0; i < charts.size(); ++i)
    svg += format("<g transform=\"translate(%.0f 0)\">\n", kWidth * static_cast<double>(i)) +
           body(charts[i], i) + "</g>\n";
  return svg + "</svg>\n";
}

std::string to_svg(const Chart& chart) { return to_svg(std::vector<Chart>{chart}); }

}  // namespace posevote::plot
