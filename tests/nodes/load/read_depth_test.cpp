// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/load/read_depth.hpp"

#include "tests/nodes/formats/support.hpp"

namespace posevote::read_depth_test {

using namespace posevote::load;
using namespace posevote::test;

namespace {

const Camera kCamera{500, 400, 1.5, 0.5, 0.1};

Scan read_points(const std::filesystem::path& path, const Camera& camera,
                 const load::DepthRange& range) {
  return load::points_of(load::read_depth(path, camera, range), nullptr, camera, range);
}

std::string depth_error(const std::string& bytes, const Camera& camera = kCamera,
                        const load::DepthRange& range = {}) {
  const TempDir dir;
  const auto path = dir.write("depth.png", bytes);
  return error_of([&] { read_points(path, camera, range); });
}

void put_big_endian(std::string& bytes, std::size_t at, std::uint32_t value) {
  std::string word;
  append(word, value, std::endian::big);
  bytes.replace(at, 4, word);
}

/// Gives a PNG other dimensions, and the checksum that goes with them.
std::string with_size(std::string bytes, std::uint32_t width, std::uint32_t height) {
  constexpr std::size_t kChunk = 12, kData = 16, kEnd = 29;  // "IHDR", its content, its checksum
  put_big_endian(bytes, kData, width);
  put_big_endian(bytes, kData + 4, height);
  std::uint32_t crc = ~0U;
  for (std::size_t i = kChunk; i < kEnd; ++i) {
    crc ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) ? 0xedb88320U : 0U);
  }
  put_big_endian(bytes, kEnd, ~crc);
  return bytes;
}

}  // namespace

TEST_CASE("Depth image: pixels become points right, down and forward", "[load][depth]") {
  const TempDir dir;
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    const auto path =
        dir.write("depth.png", depth_png(4, 2, {0, 10000, 0, 20000, 5000, 0, 0, 258}, interlace));
    const Scan scan = read_points(path, kCamera, {});
    REQUIRE(scan.points.rows() == 4);
    CHECK(scan.points.row(0).isApprox(
        Eigen::RowVector3f(-0.5F / 500, -0.5F / 400, 1)));  // u = 1, v = 0, 10000 x 0.1 mm
    CHECK(scan.points.row(1).isApprox(Eigen::RowVector3f(2 * 1.5F / 500, 2 * -0.5F / 400, 2)));
    CHECK(scan.points.row(2).isApprox(
        Eigen::RowVector3f(0.5F * -1.5F / 500, 0.5F * 0.5F / 400, 0.5F)));
    CHECK(scan.points(3, 2) == Approx(0.0258));  // 258 = 0x0102: bytes in the right order
    CHECK(scan.view.origin.isZero());
    CHECK(scan.view.image.min().isApprox(Eigen::Vector2f(-2.0F / 500, -1.0F / 400)));
    CHECK(scan.view.image.max().isApprox(Eigen::Vector2f(2.0F / 500, 1.0F / 400)));
    CHECK(is_valid(scan));
  }
}

TEST_CASE("Depth image: limits", "[load][depth]") {
  const TempDir dir;
  const auto path = dir.write("depth.png", depth_png(3, 1, {5000, 10000, 20000}));
  CHECK(read_points(path, kCamera, {0.6, 0}).points.rows() == 2);
  CHECK(read_points(path, kCamera, {0, 1.5}).points.rows() == 2);
  CHECK(read_points(path, kCamera, {0.6, 1.5}).points.rows() == 1);
  CHECK_THAT(error_of([&] { read_points(path, kCamera, {3, 4}); }), has("none of the image's 3"));
  CHECK_THAT(depth_error(depth_png(2, 2, {0, 0, 0, 0})), has("none of the image's 4 pixels"));
}

TEST_CASE("Depth image: a camera that cannot be", "[load][depth]") {
  const std::string image = depth_png(2, 1, {1, 2});
  CHECK_THAT(depth_error(image, Camera{}), has("set load_scene.fx, fy, cx and cy"));
  CHECK_THAT(depth_error(image, Camera{500, 0, 1, 1, 1}), has("fy = 0.000000"));
  CHECK_THAT(depth_error(image, Camera{500, 500, 0, 0, 1}), has("needs its camera"));
  CHECK_THAT(depth_error(image, Camera{500, std::nan(""), 1, 1, 1}), has("needs its camera"));
  CHECK_THAT(depth_error(image, Camera{1e-300, 500, 1, 1, 1}), has("needs its camera"));
  CHECK_THAT(depth_error(image, Camera{500, 500, HUGE_VAL, 1, 1}), has("needs its camera"));
  CHECK_THAT(depth_error(image, Camera{500, 500, 1, 1, 0}), has("depth_scale is 0"));
  CHECK_THAT(depth_error(image, Camera{500, 500, 1, 1, HUGE_VAL}), has("depth_scale is inf"));
}

TEST_CASE("Depth image: other images are refused", "[load][depth]") {
  CHECK_THAT(depth_error(png_bytes(2, 1, 8, 1, "ab")), has("8-bit grey, expected 16-bit grey"));
  CHECK_THAT(depth_error(png_bytes(1, 1, 8, 3, "abc")), has("8-bit colour"));
  CHECK_THAT(depth_error(png_bytes(1, 1, 16, 3, "abcdef")), has("16-bit colour"));
  CHECK_THAT(depth_error("not an image"), has("not a PNG file: starts with 'not an image'"));
  CHECK_THAT(depth_error("\x89PNG"), has("not a PNG file"));
}

TEST_CASE("Depth image: dimensions that the file cannot hold", "[load][depth]") {
  const std::string image = depth_png(2, 1, {1, 2});
  CHECK_THAT(depth_error(with_size(image, 8000, 8000)), has("claims 8000 x 8000 pixels"));
  CHECK_THAT(depth_error(with_size(image, 2000000000, 1)), has("damaged PNG file"));
  CHECK_THAT(depth_error(with_size(image, 0, 1)), has("damaged PNG file"));
  CHECK_THAT(depth_error(with_size(image, 2, 3)), has("damaged PNG file"));
}

TEST_CASE("Depth image: cut off anywhere is an error", "[load][depth]") {
  std::vector<std::uint16_t> values;
  for (std::uint32_t i = 0; i < 300; ++i) values.push_back(static_cast<std::uint16_t>(i * i + 1));
  const std::string whole = depth_png(20, 15, values);
  for (std::size_t size = 0; size < whole.size(); size += 5)
    CHECK(depth_error(whole.substr(0, size)) != "(no error)");
  CHECK_THAT(depth_error(whole.substr(0, whole.size() - 20)), has("the file ends too early"));
}

}  // namespace posevote::read_depth_test
