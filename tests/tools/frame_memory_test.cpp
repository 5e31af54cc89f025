// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/support/bag_writer.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/stream/memory.hpp"

namespace posevote::frame_memory_test {

using namespace posevote::test;

namespace {

std::string png_head() {
  return std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) + std::string("\0\0\x20\0\0\0\x10\0", 8) +
         "and so on";
}

}  // namespace

TEST_CASE("what a frame will take is told from its file's head", "[memory]") {
  const TemporaryFolder folder;
  SceneFile file;
  stream::ScanSizes sizes;
  file.path = folder.write("a.png", png_head());
  CHECK(sizes.expected(file) == std::size_t{64} * 8192 * 4096);
  file.path = folder.write("a.ply", std::string(1000, ' '));
  CHECK(sizes.expected(file) == 6000);
  file.path = folder.write("b.png", "no");
  CHECK(sizes.expected(file) < 1000);
  file.path = folder / "none.png";
  CHECK(sizes.expected(file) == 0);
  BagWriter bag;
  bag.add("/d", "sensor_msgs/Image", 1,
          ros_image(100, 50, "16UC1", std::vector<std::uint16_t>(5000)));
  file.path = std::filesystem::path(folder.write("a.bag", bag.bytes())) / "d/000000";
  CHECK(sizes.expected(file) / 64 >= 5000);
  CHECK(sizes.expected(file) / 64 < 5100);
  file.path = folder / "a.bag/d/000001";  // not looked for: one of the topic stands for all
  CHECK(sizes.expected(file) / 64 >= 5000);
  CHECK(stream::ScanSizes().expected(file) == 0);
}

TEST_CASE("half of the machine's memory, unless another limit is asked for", "[memory]") {
  CHECK(stream::memory_limit(1000) == 1000);
  CHECK(stream::memory_limit(0) > 100'000'000);
  CHECK(stream::most_points(6400) == 100);
}

}  // namespace posevote::frame_memory_test
