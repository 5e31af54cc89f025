// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>
#include <variant>

#include "nodes/formats/raw_mesh.hpp"
#include "nodes/formats/triangulate.hpp"
#include "tests/fuzz/reader.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::test {
namespace {

std::string ply(const std::string& kind) {
  return "ply\nformat " + kind +
         " 1.0\ncomment of a test\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string binary_ply(std::endian order) {
  std::string bytes =
      ply(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (int i = 0; i < 24; ++i) append(bytes, static_cast<float>(i * i % 17), order);
  for (int face = 0; face < 2; ++face) {
    append<std::uint8_t>(bytes, 3);
    for (int k = 0; k < 3; ++k) append(bytes, face + k, order);
  }
  return bytes;
}

std::string pcd(const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z normal_x normal_y normal_z\n"
         "SIZE 4 4 4 4 4 4\nTYPE F F F F F F\nCOUNT 1 1 1 1 1 1\nWIDTH 4\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA " +
         data + "\n";
}

std::string rows(int count, int width) {
  std::string text;
  for (int i = 0; i < count * width; ++i)
    text += std::to_string(i * i % 17) + ((i + 1) % width ? ".5 " : ".25\n");
  return text;
}

std::string floats(int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) append(bytes, static_cast<float>(i * i % 17));
  return bytes;
}

std::string compressed_pcd() { return pcd("binary_compressed") + lzf_block(floats(24)); }

std::string binary_stl() {
  std::string bytes(80, ' ');
  append<std::uint32_t>(bytes, 3);
  for (int i = 0; i < 3; ++i) bytes += floats(12) + "ab";
  return bytes;
}

std::string ascii_stl() {
  std::string text = "solid thing\n";
  for (int i = 0; i < 3; ++i)
    text += "facet normal 0 0 1\nouter loop\nvertex 0 0 " + std::to_string(i) +
            "\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  return text + "endsolid thing\n";
}

const std::string kFaces = "3 0 1 2\n3 1 2 3\n";

Reader mesh_reader(const std::string& ending, std::vector<Sample> samples) {
  return {ending,
          [ending](std::string_view bytes) {
            if (!is_valid(formats::to_scan(read_raw("." + ending, bytes), 0.001)))
              throw std::logic_error("not a valid scan");
          },
          std::move(samples)};
}

Reader depth_reader(const std::string& ending, std::vector<Sample> samples) {
  return {ending,
          [read = std::get<formats::ReadDepth>(formats::find_format("a." + ending)->read)](
              std::string_view bytes) {
            const formats::DepthImage image = read(bytes);
            if (std::max(image.values.size(), image.metres.size()) != image.width * image.height)
              throw std::logic_error("not a valid image");
          },
          std::move(samples)};
}

std::vector<std::uint16_t> depths() {
  std::vector<std::uint16_t> depths;
  for (int i = 0; i < 80; ++i) depths.push_back(static_cast<std::uint16_t>(i * 701 % 5000));
  return depths;
}

}  // namespace

std::vector<Reader> geometry_readers() {
  return {mesh_reader("ply", {{"ascii", ply("ascii") + rows(4, 6) + kFaces},
                              {"little-endian", binary_ply(std::endian::little)},
                              {"big-endian", binary_ply(std::endian::big)}}),
          mesh_reader("pcd", {{"ascii", pcd("ascii") + rows(4, 6)},
                              {"binary", pcd("binary") + floats(24)},
                              {"compressed", compressed_pcd()}}),
          mesh_reader(
              "obj",
              {{"triangles", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf -3 -2 -1\n",
                false},
               {"polygon", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 2 3 4 5 6 1\n",
                false}}),
          mesh_reader("stl", {{"ascii", ascii_stl()}, {"binary", binary_stl()}}),
          mesh_reader("off", {{"OFF", "OFF\n4 2 0\n" + rows(4, 3) + kFaces},
                              {"NOFF", "NOFF\n4 2 0\n" + rows(4, 6) + kFaces}}),
          depth_reader("png", {{"16 bits", depth_png(10, 8, depths())}}),
          depth_reader("npy", {{"16 bits", npy("<u2", "(8, 10)", values(depths()))}})};
}

}  // namespace posevote::test
