// SPDX-License-Identifier: BSD-3-Clause
// Whatever happened to a file on its way: a reader returns a valid scan or throws a
// std::runtime_error, and asks for no more memory than the file's size justifies.
#include <sys/resource.h>

#include <functional>
#include <random>

#include "nodes/formats/raw_mesh.hpp"
#include "nodes/formats/triangulate.hpp"
#include "tests/nodes/formats/support.hpp"

using namespace posevote;
using namespace posevote::formats;
using namespace posevote::test;

namespace {

/// Lets the process grow by some 64 MB only. The address sanitizer's own reservations rule it out.
class MemoryLimit {
 public:
  MemoryLimit() {
    ::getrlimit(RLIMIT_AS, &before_);
#ifndef __SANITIZE_ADDRESS__
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + (64U << 20U);
    ::setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

struct Sample {
  std::string name;
  std::string bytes;
  std::function<void(std::string_view)> check;  ///< throws, or fails the test
};

std::function<void(std::string_view)> mesh_check(const std::string& ending) {
  return [ending](std::string_view bytes) {
    const Scan scan = formats::to_scan(read_raw(ending, bytes), 0.001);
    REQUIRE(is_valid(scan));
  };
}

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

std::vector<Sample> samples() {
  const std::string faces = "3 0 1 2\n3 1 2 3\n";
  std::vector<std::uint16_t> depths;
  for (int i = 0; i < 80; ++i) depths.push_back(static_cast<std::uint16_t>(i * 701 % 5000));
  const auto depth_check = [](const char* ending) {
    return [read = std::get<formats::ReadDepth>(formats::find_format(ending)->read)](
               std::string_view bytes) {
      const formats::DepthImage image = read(bytes);
      REQUIRE(std::max(image.values.size(), image.metres.size()) == image.width * image.height);
    };
  };
  return {{"ascii PLY", ply("ascii") + rows(4, 6) + faces, mesh_check(".ply")},
          {"little-endian PLY", binary_ply(std::endian::little), mesh_check(".ply")},
          {"big-endian PLY", binary_ply(std::endian::big), mesh_check(".ply")},
          {"ascii PCD", pcd("ascii") + rows(4, 6), mesh_check(".pcd")},
          {"binary PCD", pcd("binary") + floats(24), mesh_check(".pcd")},
          {"compressed PCD", compressed_pcd(), mesh_check(".pcd")},
          {"OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf -3 -2 -1\n",
           mesh_check(".obj")},
          {"OBJ polygon", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 2 3 4 5 6 1\n",
           mesh_check(".obj")},
          {"ascii STL", ascii_stl(), mesh_check(".stl")},
          {"binary STL", binary_stl(), mesh_check(".stl")},
          {"OFF", "OFF\n4 2 0\n" + rows(4, 3) + faces, mesh_check(".off")},
          {"NOFF", "NOFF\n4 2 0\n" + rows(4, 6) + faces, mesh_check(".off")},
          {"PNG", depth_png(10, 8, depths), depth_check("a.png")},
          {"NPY", npy("<u2", "(8, 10)", values(depths)), depth_check("a.npy")}};
}

/// True if it was taken for a valid file.
bool survives(const Sample& sample, std::string_view bytes) {
  try {
    sample.check(bytes);
    return true;
  } catch (const std::runtime_error& error) {
    REQUIRE(std::string(error.what()).size() > 5);
    REQUIRE(std::string(error.what()).size() < 400);
    return false;
  }
}

/// One to four changes: a byte, a bit, a piece left out or doubled, a number made large.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, 1 + below(8));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(12)));
        break;
      case 4:
        bytes.replace(at, 1, "4294967295");
        break;
      default:
        bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at), "\xff\xff\xff\xff");
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("Damage: every sample is whole to begin with", "[load][damage]") {
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    CHECK(survives(sample, sample.bytes));
  }
}

TEST_CASE("Damage: files cut off at every byte", "[load][damage]") {
  const MemoryLimit limit;
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    // A text may lack its last line end, and what a cut within its last number left is a number. An
    // OBJ file has no counts: it ends anywhere.
    const std::size_t last_line = sample.bytes.rfind('\n', sample.bytes.size() - 2);
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      INFO("cut to " << size);
      const bool taken = survives(sample, std::string_view(sample.bytes).substr(0, size));
      if (size < last_line && !sample.name.starts_with("OBJ")) CHECK_FALSE(taken);
    }
  }
}

TEST_CASE("Damage: bytes changed at random", "[load][damage]") {
  const MemoryLimit limit;
  std::mt19937 random(20170917);
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    int taken = 0;
    for (int i = 0; i < 600; ++i) taken += survives(sample, damaged(sample.bytes, random));
    CHECK(taken < 600);
  }
}

TEST_CASE("Damage: random bytes behind a good beginning", "[load][damage]") {
  const MemoryLimit limit;
  std::mt19937 random(7);
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    for (std::size_t i = 0; i < 100; ++i) {
      std::string bytes = sample.bytes.substr(0, sample.bytes.size() * i / 100);
      while (bytes.size() < sample.bytes.size()) bytes += static_cast<char>(random() % 256U);
      survives(sample, bytes);
    }
  }
}
