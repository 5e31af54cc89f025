// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/load/edge_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace posevote::load {
namespace {

// In widths of the image: what a depth image leaves out beside a step, how far edges lie off, and
// how far a far shift goes.
constexpr double kGap = 1.0 / 64, kOff = 1.0 / 200, kFar = 1.0 / 32;
constexpr double kStep = 0.04;  // of the depth
constexpr int kRings = 6, kDirections = 12;
constexpr std::size_t kFewestSteps = 200, kMostSteps = 6000;
constexpr std::size_t kSmallest = 160;  // [pixel] of the shorter side

struct Pixel {
  int x, y;
};

/// An image's pixels along one row or column.
struct Line {
  std::size_t first, stride, count;
};

std::vector<Line> lines_of(std::size_t width, std::size_t height, bool down) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < (down ? width : height); ++i)
    lines.push_back(down ? Line{i, width, height} : Line{i * width, 1, width});
  return lines;
}

/// Where the depth steps: the nearer side, across what was not measured between.
std::vector<Pixel> steps_of(const LoadedDepth& image) {
  const auto gap = static_cast<std::size_t>(kGap * static_cast<double>(image.width));
  std::vector<char> is_step(image.depths.size(), 0);
  for (const bool down : {false, true})
    for (const Line& line : lines_of(image.width, image.height, down)) {
      std::size_t last = line.count;  // the last that was measured
      for (std::size_t k = 0; k < line.count; ++k) {
        const std::size_t at = line.first + k * line.stride;
        const float depth = image.depths[at];
        if (!(depth > 0 && std::isfinite(depth))) continue;
        if (last < line.count && k - last <= gap) {
          const std::size_t before = line.first + last * line.stride;
          const float other = image.depths[before];
          if (other > (1 + kStep) * depth) is_step[at] = 1;
          if (depth > (1 + kStep) * other) is_step[before] = 1;
        }
        last = k;
      }
    }
  const auto count = static_cast<std::size_t>(std::count(is_step.begin(), is_step.end(), 1));
  const std::size_t stride = count / kMostSteps + 1;
  std::vector<Pixel> steps;
  std::size_t number = 0;
  for (std::size_t i = 0; i < is_step.size(); ++i)
    if (is_step[i] && number++ % stride == 0)
      steps.push_back({static_cast<int>(i % image.width), static_cast<int>(i / image.width)});
  return steps;
}

/// How much the colour changes at each pixel: of the channel that changes most, in units of 1/2.
std::vector<std::uint16_t> changes_of(const ColorImage& color) {
  std::vector<std::uint16_t> changes(color.width * color.height, 0);
  const auto value = [&color](std::size_t x, std::size_t y, std::size_t channel) {
    return static_cast<double>(color.values[3 * (y * color.width + x) + channel]);
  };
  for (std::size_t y = 1; y + 1 < color.height; ++y)
    for (std::size_t x = 1; x + 1 < color.width; ++x) {
      double most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::hypot(value(x + 1, y, c) - value(x - 1, y, c),
                                         value(x, y + 1, c) - value(x, y - 1, c)));
      changes[y * color.width + x] = static_cast<std::uint16_t>(2 * most);
    }
  return changes;
}

/// The most of each pixel's surroundings along lines.
void spread(const std::vector<Line>& lines, std::size_t reach,
            std::vector<std::uint16_t>& changes) {
  std::vector<std::uint16_t> along;
  for (const Line& line : lines) {
    along.resize(line.count);
    for (std::size_t k = 0; k < line.count; ++k) along[k] = changes[line.first + k * line.stride];
    for (std::size_t k = 0; k < line.count; ++k) {
      const auto begin = along.begin() + static_cast<std::ptrdiff_t>(k - std::min(k, reach));
      const auto end =
          along.begin() + static_cast<std::ptrdiff_t>(std::min(line.count, k + reach + 1));
      changes[line.first + k * line.stride] = *std::max_element(begin, end);
    }
  }
}

/// Of each pixel the share of pixels with less change: whatever the exposure.
std::vector<float> ranks_of(const ColorImage& color) {
  std::vector<std::uint16_t> changes = changes_of(color);
  const auto reach = static_cast<std::size_t>(std::lround(kOff * static_cast<double>(color.width)));
  for (const bool down : {false, true})
    spread(lines_of(color.width, color.height, down), reach, changes);
  std::array<std::size_t, 1024> less{};
  for (const std::uint16_t change : changes) ++less[change + 1U];
  std::partial_sum(less.begin(), less.end(), less.begin());
  std::vector<float> ranks(changes.size());
  const auto all = static_cast<float>(changes.size());
  for (std::size_t i = 0; i < ranks.size(); ++i)
    ranks[i] = static_cast<float>(less[changes[i]]) / all;
  return ranks;
}

/// In turn, all around.
std::vector<Pixel> ring(double radius, int directions) {
  std::vector<Pixel> shifts;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    shifts.push_back({static_cast<int>(std::lround(radius * std::cos(angle))),
                      static_cast<int>(std::lround(radius * std::sin(angle)))});
  }
  return shifts;
}

/// The mean rank at the shifted steps; of those beside the image none counts.
double mean_rank(const std::vector<Pixel>& steps, const std::vector<float>& ranks,
                 const LoadedDepth& image, const Pixel& shift) {
  const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  double sum = 0, count = 0;
  for (const Pixel& step : steps) {
    const int x = step.x + shift.x, y = step.y + shift.y;
    if (x < 0 || y < 0 || x >= width || y >= height) continue;
    sum += static_cast<double>(
        ranks[static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)]);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

EdgeMatch match_edges(const LoadedDepth& image, const ColorImage& color) {
  EdgeMatch match;
  if (std::min(image.width, image.height) < kSmallest) return match;
  const std::vector<Pixel> steps = steps_of(image);
  match.steps = steps.size();
  if (steps.size() < kFewestSteps) return match;
  const std::vector<float> ranks = ranks_of(color);
  if (*std::max_element(ranks.begin(), ranks.end()) <= 0) return match;
  const auto width = static_cast<double>(image.width);
  const auto at = [&](const Pixel& shift) { return mean_rank(steps, ranks, image, shift); };
  match.here = at({0, 0});
  for (const double radius : {kOff, 2 * kOff})
    for (const Pixel& shift : ring(radius * width, 8)) match.here = std::max(match.here, at(shift));
  for (int i = 0; i < kRings; ++i)
    for (const Pixel& shift : ring((2 + i) * kFar / 2 * width, kDirections)) {
      const double there = at(shift);
      match.elsewhere += there / (kRings * kDirections);
      match.better += there >= match.here ? 1 : 0;
    }
  return match;
}

}  // namespace posevote::load
