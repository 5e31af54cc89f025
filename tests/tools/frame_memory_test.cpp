// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/support/bag_writer.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/stream/memory.hpp"

using namespace posevote;
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
  file.path = folder.write("a.png", png_head());
  CHECK(stream::expected_bytes(file) == std::size_t{64} * 8192 * 4096);
  file.path = folder.write("a.ply", std::string(1000, ' '));
  CHECK(stream::expected_bytes(file) == 6000);
  file.path = folder.write("b.png", "no");
  CHECK(stream::expected_bytes(file) < 1000);
  file.path = folder / "none.png";
  CHECK(stream::expected_bytes(file) == 0);
  BagWriter bag;
  bag.add("/d", "sensor_msgs/Image", 1,
          ros_image(100, 50, "16UC1", std::vector<std::uint16_t>(5000)));
  file.path = std::filesystem::path(folder.write("a.bag", bag.bytes())) / "d/000000";
  CHECK(stream::expected_bytes(file) / 64 >= 5000);
  CHECK(stream::expected_bytes(file) / 64 < 5100);
  file.path = folder / "a.bag/d/000001";
  CHECK(stream::expected_bytes(file) == 0);
}

TEST_CASE("as many frames are in flight as memory has room for the largest", "[memory]") {
  const TemporaryFolder folder;
  std::vector<SceneEntry> scans(2);
  scans[0].file.path = folder.write("a.ply", std::string(100, ' '));
  scans[1].file.path = folder.write("a.png", png_head());
  const std::size_t large = std::size_t{64} * 8192 * 4096;
  CHECK(stream::tokens_within(10 * large, 4, scans) == 4);
  CHECK(stream::tokens_within(3 * large, 4, scans) == 3);
  CHECK(stream::tokens_within(large / 2, 4, scans) == 1);
  CHECK(stream::tokens_within(large / 2, 4, {scans[0]}) == 4);
  CHECK(stream::memory_limit(1000) == 1000);
  CHECK(stream::memory_limit(0) > 100'000'000);
  CHECK(stream::most_points(6400) == 100);
}
