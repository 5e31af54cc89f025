// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/load/edge_match.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

namespace posevote::edge_match_test {

using load::is_of_one_view;

namespace {

constexpr std::size_t kWidth = 320, kHeight = 240;

/// Boxes of any colour before a wall, each with a stripe; `noise` of colours.
LoadedDepth boxes(std::uint32_t seed, std::size_t width = kWidth, std::size_t height = kHeight) {
  std::mt19937 random(seed);
  const auto below = [&random](std::size_t end) { return std::size_t{random()} % end; };
  LoadedDepth image{width, height, std::vector<float>(width * height, 1.5F)};
  auto color = std::make_shared<ColorImage>(
      ColorImage{width, height, std::vector<std::uint8_t>(3 * width * height, 120)});
  for (int i = 0; i < 12; ++i) {
    const std::size_t w = width / 12 + below(width / 6), h = height / 12 + below(height / 6);
    const std::size_t left = below(width - w), top = below(height - h);
    const float depth = 1.2F - 0.05F * static_cast<float>(i);
    std::array<std::uint8_t, 3> paint{};
    for (std::uint8_t& channel : paint) channel = static_cast<std::uint8_t>(below(256));
    for (std::size_t y = top; y < top + h; ++y)
      for (std::size_t x = left; x < left + w; ++x) {
        const std::size_t at = y * width + x;
        image.depths[at] = x - left < 3 ? 0 : depth;  // as sensors see no depth beside a step
        for (std::size_t c = 0; c < 3; ++c)
          color->values[3 * at + c] = y - top == h / 2 ? 255 : paint[c];
      }
  }
  for (std::uint8_t& value : color->values)
    value = static_cast<std::uint8_t>(std::min<std::size_t>(255, value + below(8)));
  image.color = color;
  return image;
}

template <class Change>
LoadedDepth recolored(const LoadedDepth& image, Change change) {
  LoadedDepth other = image;
  auto color = std::make_shared<ColorImage>(*image.color);
  change(*color);
  other.color = color;
  return other;
}

load::EdgeMatch match_edges(const LoadedDepth& image) {
  return load::match_edges(image, *image.color);
}

}  // namespace

TEST_CASE("edge match: an image's own colours have edges where its depth steps", "[load][color]") {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const LoadedDepth image = boxes(seed);
    const load::EdgeMatch match = match_edges(image);
    INFO(seed << ": " << match.here << " " << match.elsewhere << " " << match.better);
    CHECK(match.steps > 200);
    CHECK(match.here > match.elsewhere + 0.1);
    CHECK(match.better == 0);
    CHECK(is_of_one_view(match_edges(recolored(image, [](ColorImage& color) {
      for (std::uint8_t& value : color.values) value /= 3;  // another exposure
    }))));
  }
}

TEST_CASE("edge match: another image's colours do not match, nor shifted ones", "[load][color]") {
  int noticed = 0, noticed_shifts = 0;
  constexpr std::uint32_t kImages = 10;
  for (std::uint32_t seed = 1; seed <= kImages; ++seed) {
    LoadedDepth image = boxes(seed);
    const LoadedDepth shifted = recolored(image, [](ColorImage& color) {
      std::rotate(color.values.begin(), color.values.begin() + 3 * 25, color.values.end());
    });
    noticed_shifts += is_of_one_view(match_edges(shifted)) ? 0 : 1;
    image.color = boxes(100 + seed).color;
    noticed += is_of_one_view(match_edges(image)) ? 0 : 1;
  }
  CHECK(noticed >= 8);
  CHECK(noticed_shifts >= 8);
}

TEST_CASE("edge match: where nothing can be told, colours match", "[load][color]") {
  LoadedDepth image = boxes(1);
  image.color = boxes(2).color;
  LoadedDepth small = boxes(1, 120, 100), even = image, none = image;
  small.color = boxes(2, 120, 100).color;
  CHECK(is_of_one_view(match_edges(small)));
  std::fill(even.depths.begin(), even.depths.end(), 1.F);
  CHECK(is_of_one_view(match_edges(even)));
  for (const float nothing : {0.F, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), -1.F}) {
    std::fill(none.depths.begin(), none.depths.end(), nothing);
    CHECK(is_of_one_view(match_edges(none)));
  }
  CHECK(is_of_one_view(match_edges(recolored(image, [](ColorImage& color) {
    std::fill(color.values.begin(), color.values.end(), std::uint8_t{77});
  }))));
}

}  // namespace posevote::edge_match_test
