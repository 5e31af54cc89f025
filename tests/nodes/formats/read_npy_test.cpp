// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/depth_image.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::read_npy_test {

using namespace posevote::test;
using formats::DepthImage;

namespace {

DepthImage read(const std::string& bytes) {
  const TempDir dir;
  return formats::read_depth_image(dir.write("depth.npy", bytes));
}

}  // namespace

TEST_CASE("NumPy depth images: raw whole numbers, or metres", "[formats]") {
  for (const auto& [descr, order] :
       {std::pair("<u2", std::endian::little), std::pair(">u2", std::endian::big)}) {
    const DepthImage raw =
        read(npy(descr, "(2, 3)", values<std::uint16_t>({1, 2, 3, 4, 5, 600}, order)));
    CHECK(raw.width == 3);
    CHECK(raw.height == 2);
    CHECK(raw.values == std::vector<std::uint16_t>{1, 2, 3, 4, 5, 600});
    CHECK(formats::depths_of(raw, 0.1)[5] == Approx(0.06));
  }
  const DepthImage floats = read(npy("<f4", "(1, 2)", values<float>({0.5F, 1.25F})));
  CHECK(formats::depths_of(floats, 0.1) == std::vector<float>{0.5F, 1.25F});
  CHECK(read(npy("<f8", "(1, 2)", values<double>({0.5, 1.25}))).metres ==
        std::vector<float>{0.5F, 1.25F});
}

TEST_CASE("NumPy files that are no depth images say why", "[formats]") {
  const std::string two = values<std::uint16_t>({1, 2});
  for (const auto& [bytes, what] : std::vector<std::pair<std::string, std::string>>{
           {"PK\x03\x04", "not a NumPy file"},
           {npy("<u2", "(2,)", two), "expected (height, width)"},
           {npy("<u2", "(1, 2, 3)", two), "expected (height, width)"},
           {npy("<u2", "(99999, 99999)", two), "claims 99999 x 99999 pixels"},
           {npy("<u2", "(2, 2)", two), "ends after 4 of 8 bytes"},
           {npy("<u2", "(1, 1)", two), "more data than its shape says"},
           {npy("<i8", "(1, 2)", two), "expected uint16 (raw), float32"},
           {npy("<u2", "(1, 2)", two, "True"), "column by column"},
           {npy("<u2", "(1, 2)", two).substr(0, 30), "header claims"}})
    CHECK_THAT(error_of([&, &damaged = bytes] { read(damaged); }), Catch::Contains(what));
}

}  // namespace posevote::read_npy_test
