// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pictures/canvas.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/nodes/write/picture.hpp"
#include "tests/nodes/write/writer.hpp"
#include "tests/support/instruction_set.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::canvas_test {

using posevote::test::Picture;
using posevote::test::TemporaryFolder;

namespace {

const pictures::Colour kRed(1, 0, 0), kGreen(0, 1, 0), kWhite(1, 1, 1);

pictures::Disc disc(float x, float y, float depth, float radius) {
  pictures::Disc made;
  made.x = x, made.y = y, made.depth = depth, made.radius = radius;
  return made;
}

Picture saved(const pictures::Canvas& canvas) {
  const TemporaryFolder folder;
  canvas.save(folder / "a.png");
  return Picture(folder / "a.png");
}

}  // namespace

TEST_CASE("what is nearer is seen, in whatever order it is drawn", "[write]") {
  for (const bool near_first : {true, false}) {
    pictures::Canvas canvas(40, 30, kWhite);
    for (const bool near : {near_first, !near_first})
      canvas.draw(near ? disc(20, 10, 1, 3) : disc(20, 10, 2, 6), near ? kRed : kGreen);
    const Picture picture = saved(canvas);
    CHECK(picture.at(20, 10) == formats::Rgb{255, 0, 0});
    CHECK(picture.at(22, 10) == formats::Rgb{255, 0, 0});
    CHECK(picture.at(25, 10) == formats::Rgb{0, 255, 0});
    CHECK(picture.at(10, 20) == formats::Rgb{255, 255, 255});
  }
}

TEST_CASE("an outline is the edge of what was drawn on another canvas", "[write][color]") {
  pictures::Canvas canvas(40, 30, kWhite), shape(40, 30, kWhite);
  shape.draw(disc(20, 15, 1, 8), kGreen);
  canvas.outline(shape, 2, kRed);
  const Picture picture = saved(canvas);
  CHECK(picture.at(27, 15) == formats::Rgb{255, 0, 0});
  CHECK(picture.at(20, 22) == formats::Rgb{255, 0, 0});
  CHECK(picture.at(20, 15) == formats::Rgb{255, 255, 255});
  CHECK(picture.at(32, 15) == formats::Rgb{255, 255, 255});
}

TEST_CASE("a disc is round; tilted, it is narrow and its depth varies", "[write]") {
  pictures::Canvas canvas(60, 60, kWhite);
  canvas.draw(disc(30, 30, 10, 20), kGreen);
  CHECK(saved(canvas).at(46, 46) ==
        formats::Rgb{255, 255, 255});  // a corner of the square around it
  CHECK(saved(canvas).at(30, 49) == formats::Rgb{0, 255, 0});
  pictures::Disc tilted = disc(30, 30, 10, 20);
  tilted.tilt = {-1, 0};  // nearer to the right
  canvas.draw(tilted, kRed);
  const Picture picture = saved(canvas);
  CHECK(picture.at(40, 30) == formats::Rgb{255, 0, 0});
  CHECK(picture.at(20, 30) == formats::Rgb{0, 255, 0});
  CHECK(picture.at(45, 30) ==
        formats::Rgb{0, 255, 0});  // 15 pixels across at 45 degrees: beyond its edge
}

TEST_CASE("discs are drawn as they are defined, on each instruction set, at the edges too",
          "[write]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  constexpr int kWidth = 61, kHeight = 47;
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(random()) / 4294967295.0);
  };
  std::vector<pictures::Disc> discs;
  std::vector<pictures::Colour> colours;
  for (int i = 0; i < 120; ++i) {
    pictures::Disc& made =
        discs.emplace_back(disc(uniform(-20, 80), uniform(-20, 66), uniform(1, 2), uniform(0, 30)));
    made.tilt = {uniform(-2, 2), uniform(-2, 2)};
    made.pixel = 0.01F;
    colours.emplace_back(uniform(0, 1), uniform(0, 1), uniform(0, 1));
  }
  // The nearest disc of each pixel; -2 where rounding decides.
  const auto nearest = [&](int x, int y) {
    int best = -1;
    double depth = 1e9;
    bool is_clear = true;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const pictures::Disc& d = discs[i];
      const auto dx = static_cast<double>(x - std::lround(d.x));
      const auto dy = static_cast<double>(y - std::lround(d.y));
      const double gain =
          static_cast<double>(d.tilt.x()) * dx + static_cast<double>(d.tilt.y()) * dy;
      const double squared = dx * dx + dy * dy + gain * gain,
                   radius = static_cast<double>(d.radius);
      const bool is_inside =
          squared <= radius * radius && std::max(std::abs(dx), std::abs(dy)) <= std::floor(radius);
      const double here = static_cast<double>(d.depth) + gain * static_cast<double>(d.pixel);
      is_clear =
          is_clear && std::abs(squared - radius * radius) > 1e-3 && std::abs(here - depth) > 1e-5;
      if (!is_inside || here >= depth) continue;
      best = static_cast<int>(i);
      depth = here;
    }
    return is_clear ? best : -2;
  };
  pictures::Canvas canvas(kWidth, kHeight, kWhite);
  for (std::size_t i = 0; i < discs.size(); ++i) canvas.draw(discs[i], colours[i]);
  const Picture picture = saved(canvas);
  int checked = 0, wrong = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int i = nearest(x, y);
      if (i == -2) continue;
      const pictures::Colour colour = i < 0 ? kWhite : colours[static_cast<std::size_t>(i)];
      const auto byte = [&](int k) {
        return static_cast<std::uint8_t>(std::lround(255 * colour(k)));
      };
      ++checked;
      wrong += !(picture.at(x, y) == formats::Rgb{byte(0), byte(1), byte(2)});
    }
  CHECK(checked > kWidth * kHeight / 2);
  CHECK(wrong == 0);
}

TEST_CASE("half the size: each pixel the mean of four", "[write]") {
  for (const float x : {0.0F, 1.0F})
    for (const float y : {2.0F, 3.0F}) {
      pictures::Canvas canvas(4, 4, kWhite);
      canvas.draw(disc(x, y, 1, 0), pictures::Colour(0, 0, 0));
      const Picture picture = saved(canvas.halved());
      CHECK(picture.width == 2);
      CHECK(picture.height == 2);
      CHECK(picture.at(0, 1) == formats::Rgb{191, 191, 191});
      CHECK(picture.at(0, 0) == formats::Rgb{255, 255, 255});
      CHECK(picture.at(1, 1) == formats::Rgb{255, 255, 255});
    }
}

TEST_CASE("letters stand upright, and nothing outside is drawn", "[write]") {
  pictures::Canvas canvas(30, 20, kWhite);
  canvas.text(5, 5, 1, "L", kRed);
  const Picture picture = saved(canvas);
  CHECK(picture.at(5, 5) == formats::Rgb{255, 0, 0});   // top of the stem
  CHECK(picture.at(9, 11) == formats::Rgb{255, 0, 0});  // end of the foot
  CHECK(picture.at(9, 5) != formats::Rgb{255, 0, 0});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float far : {-1e30F, -50.0F, 1e5F, 1e30F, kNan})
    canvas.draw(disc(far, far, 1, 9), kRed);
  canvas.draw(disc(kNan, 5, 1, 9), kGreen);
  canvas.draw(disc(5, kNan, 1, 9), kGreen);
  canvas.draw(disc(5, 5, kNan, 9), kGreen);
  canvas.draw(disc(5, 5, 1, kNan), kGreen);
  canvas.text(-1000, -1000, 2, "FAR \xff away", kRed);
  canvas.text(1000, 5, 2, "FAR", kRed);
  CHECK(saved(canvas).pixels == picture.pixels);
}

TEST_CASE("a picture that cannot be written is named and leaves nothing behind", "[write]") {
  const TemporaryFolder folder;
  const pictures::Canvas canvas(300, 300, kWhite);
  CHECK_THROWS_WITH(canvas.save(folder / "none/a.png"), Catch::Contains("none/a.png: cannot be"));
  std::filesystem::create_directories(folder / "b.png");
  CHECK_THROWS_WITH(canvas.save(folder / "b.png"), Catch::Contains("b.png: cannot be written"));
  const test::FullDisk full(100);
  CHECK_THROWS_WITH(canvas.save(folder / "c.png"), Catch::Contains("c.png: cannot be written"));
  for (const std::string left : {"b.png.part", "c.png", "c.png.part"})
    CHECK_FALSE(std::filesystem::exists(folder / left));
}

}  // namespace posevote::canvas_test
