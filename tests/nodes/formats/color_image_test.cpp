// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/color_image.hpp"

#include "tests/nodes/formats/support.hpp"

namespace posevote::color_image_test {

using namespace posevote::formats;
using namespace posevote::test;

TEST_CASE("a colour image is a PNG or a JPEG, whatever its name", "[load][color]") {
  const TempDir dir;
  const ColorImage png =
      read_color_image(dir.write("a.dat", png_bytes(2, 1, 8, 3, "\x01\x02\x03\x04\x05\x06")));
  CHECK(png.width == 2);
  CHECK(png.height == 1);
  CHECK(png.values == std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6});
  const ColorImage grey = read_color_image(dir.write("b.png", png_bytes(1, 1, 8, 1, "\x07")));
  CHECK(grey.values == std::vector<std::uint8_t>{7, 7, 7});

  ColorImage plain{16, 8, std::vector<std::uint8_t>(3 * 16 * 8, 100)};
  write_jpeg(plain, 90, dir.path("c.png"));
  const ColorImage jpeg = read_color_image(dir.path("c.png"));
  CHECK(jpeg.width == 16);
  CHECK(jpeg.values == plain.values);
}

TEST_CASE("damaged colour images are named as such", "[load][color]") {
  const TempDir dir;
  const auto error = [&](std::string_view bytes) {
    const auto path = dir.write("image", bytes);
    return error_of([&] { read_color_image(path); });
  };
  CHECK_THAT(error("GIF89a"), has("neither a PNG nor a JPEG image: starts with 'GIF89a'"));
  const std::string png = png_bytes(2, 2, 8, 3, std::string(12, 'x'));
  CHECK_THAT(error(png.substr(0, 20)), has("damaged PNG file"));
  CHECK_THAT(error(png.substr(0, png.size() - 20)), has("damaged PNG file"));
  ColorImage plain{64, 64, std::vector<std::uint8_t>(3 * 64 * 64, 100)};
  write_jpeg(plain, 90, dir.path("whole"));
  std::ifstream stream(dir.path("whole"), std::ios::binary);
  const std::string jpeg((std::istreambuf_iterator<char>(stream)), {});
  CHECK_THAT(error(jpeg.substr(0, jpeg.size() / 2)), has("damaged JPEG file"));
  CHECK_THAT(error(jpeg.substr(0, 30)), has("damaged JPEG file"));
}

}  // namespace posevote::color_image_test
