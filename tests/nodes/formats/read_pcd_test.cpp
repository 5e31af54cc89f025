// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <random>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/raw_mesh.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::read_pcd_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

std::string pcd_error(const std::string& bytes) {
  return error_of([&] { read_raw(".pcd", bytes); });
}

std::string header(const std::string& points, const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
         "TYPE F F F\nCOUNT 1 1 1\nWIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

/// 200 points with normals and a padded row, as PCL writes them.
struct PclCloud {
  pcl::PCLPointCloud2 cloud;
  formats::RawMesh expected;

  PclCloud() {
    const std::vector<std::string> names{"x", "y", "rgb", "z", "normal_x", "normal_y", "normal_z"};
    const std::vector<std::uint32_t> offsets{0, 4, 12, 16, 24, 28, 32};
    for (std::size_t i = 0; i < names.size(); ++i) {
      pcl::PCLPointField field;
      field.name = names[i];
      field.offset = offsets[i];
      field.datatype = pcl::PCLPointField::FLOAT32;
      field.count = 1;
      cloud.fields.push_back(field);
    }
    constexpr std::uint32_t kStep = 40;
    cloud.width = 50;
    cloud.height = 4;
    cloud.point_step = kStep;
    cloud.row_step = kStep * cloud.width;
    cloud.data.resize(std::size_t{kStep} * 200);
    std::mt19937 random(3);
    for (std::size_t i = 0; i < 200; ++i) {
      formats::Triple p, n;
      for (std::size_t k = 0; k < 3; ++k) {
        const float value = static_cast<float>(random() % 1000U) / 64.0F;
        p[k] = static_cast<double>(value);
        n[k] = static_cast<double>(-value);
        const std::size_t at = i * kStep + (k == 2 ? 16 : 4 * k);
        std::memcpy(&cloud.data[at], &value, 4);
        const float opposite = -value;
        std::memcpy(&cloud.data[i * kStep + 24 + 4 * k], &opposite, 4);
      }
      expected.points.push_back(p);
      expected.normals.push_back(n);
    }
  }
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string write_with_pcl(const PclCloud& source, int kind) {
  const TempDir dir;
  const std::string path = dir.path("cloud.pcd").string();
  pcl::PCDWriter writer;
  const Eigen::Vector4f origin(0.5F, -1.0F, 2.0F, 0.0F);
  const Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
  int result = 0;
  if (kind == 0) result = writer.writeASCII(path, source.cloud, origin, turn, 8);
  if (kind == 1) result = writer.writeBinary(path, source.cloud, origin, turn);
  if (kind == 2) result = writer.writeBinaryCompressed(path, source.cloud, origin, turn);
  REQUIRE(result >= 0);
  return contents(path);
}

}  // namespace

TEST_CASE("PCD: what PCL writes is read, in all three encodings", "[load][pcd]") {
  const PclCloud source;
  for (int kind = 0; kind < 3; ++kind) {
    const std::string bytes = write_with_pcl(source, kind);
    const formats::RawMesh mesh = read_raw(".pcd", bytes);
    CHECK(mesh.points == source.expected.points);
    CHECK(mesh.normals == source.expected.normals);
    CHECK(mesh.viewpoint == formats::Triple{0.5, -1, 2});
  }
}

TEST_CASE("PCD: PCL's binary files cut off anywhere are an error", "[load][pcd]") {
  const PclCloud source;
  for (int kind = 1; kind < 3; ++kind) {
    const std::string whole = write_with_pcl(source, kind);
    const std::size_t body = whole.find('\n', whole.find("DATA")) + 1;
    // PCL pads its files with zeros: the data ends before the file does.
    const std::size_t end =
        body + (kind == 1 ? 200 * source.cloud.point_step
                          : 8 + formats::load_bytes<std::uint32_t>(whole.data() + body));
    REQUIRE(end <= whole.size());
    for (std::size_t size = 0; size < end; size += size < 500 ? 1 : 37)
      CHECK(pcd_error(whole.substr(0, size)) != "(no error)");
    CHECK(pcd_error(whole.substr(0, end - 1)) != "(no error)");
    CHECK(pcd_error(whole.substr(0, end)) == "(no error)");
  }
}

TEST_CASE("PCD: ascii with any types, fields of several values and padding", "[load][pcd]") {
  const formats::RawMesh mesh = read_raw(
      ".pcd",
      "VERSION .5\nFIELDS histogram x _ y z\nSIZE 4 8 1 2 1\nTYPE F F U I U\nCOUNT 3 1 2 1 1\n"
      "POINTS 2\nDATA ascii\n9 9 9 1.5 0 0 -2 3\n9 9 9 nan 0 0 5 6\n");
  REQUIRE(mesh.points.size() == 2);
  CHECK(mesh.points[0] == formats::Triple{1.5, -2, 3});
  CHECK(std::isnan(mesh.points[1][0]));
  CHECK(mesh.normals.empty());
}

namespace {

/// What the reader makes of one T as x, behind padding and before y and z.
template <class T>
double read_x(T value, char type) {
  const std::string size = std::to_string(sizeof(T));
  std::string bytes = "FIELDS _ x y z\nSIZE 1 " + size + " 4 4\nTYPE U " + type +
                      " F F\nCOUNT 3 1 1 1\nWIDTH 1\nHEIGHT 1\nDATA binary\nabc";
  append(bytes, value);
  append(bytes, 1.0F);
  append(bytes, 2.0F);
  const formats::RawMesh mesh = read_raw(".pcd", bytes);
  REQUIRE(mesh.points.size() == 1);
  CHECK(mesh.points[0][1] == 1);
  CHECK(mesh.points[0][2] == 2);
  return mesh.points[0][0];
}

}  // namespace

TEST_CASE("PCD: binary with any types", "[load][pcd]") {
  CHECK(read_x<std::int8_t>(-7, 'I') == -7);
  CHECK(read_x<std::uint8_t>(200, 'U') == 200);
  CHECK(read_x<std::int16_t>(-700, 'I') == -700);
  CHECK(read_x<std::uint16_t>(60000, 'U') == 60000);
  CHECK(read_x<std::int32_t>(-70000, 'I') == -70000);
  CHECK(read_x<std::uint32_t>(4000000000U, 'U') == 4e9);
  CHECK(read_x<std::int64_t>(-70000000000, 'I') == -7e10);
  CHECK(read_x<std::uint64_t>(1ULL << 63U, 'U') == std::ldexp(1, 63));
  CHECK(read_x(0.5F, 'F') == 0.5);
  CHECK(read_x(0.25, 'F') == 0.25);
}

TEST_CASE("PCD: compressed data goes field by field, without padding fields", "[load][pcd]") {
  std::string plain;
  for (const float value : {1.0F, 2.0F, 3.0F, 4.0F}) append(plain, value);         // x, x, y, y
  for (const int value : {5, 6}) append(plain, static_cast<std::int16_t>(value));  // z, z
  const formats::RawMesh mesh =
      read_raw(".pcd",
               "FIELDS x _ y z\nSIZE 4 1 4 2\nTYPE F U F I\nCOUNT 1 8 1 1\nPOINTS 2\n"
               "DATA binary_compressed\n" +
                   lzf_block(plain));
  CHECK(mesh.points == std::vector<formats::Triple>{{1, 3, 5}, {2, 4, 6}});
}

TEST_CASE("PCD: lying counts are refused before they are believed", "[load][pcd]") {
  CHECK_THAT(pcd_error(header("4000000000", "ascii") + "1 2 3\n"),
             has("claims 4000000000 points, the file has room for at most 1"));
  CHECK_THAT(pcd_error(header("4000000000", "binary") + std::string(30, '\0')),
             has("claims 4000000000 points, the file has room for at most 2"));
  CHECK_THAT(pcd_error(header("4000000000", "binary_compressed") + std::string(30, 'x')),
             has("claims 4000000000 points"));
  std::string words = header("10", "binary_compressed");
  append<std::uint32_t>(words, 4000000000U);
  append<std::uint32_t>(words, 120);
  CHECK_THAT(pcd_error(words + "0123456789"), has("claims 4000000000 bytes of compressed data"));
  words = header("10", "binary_compressed");
  append<std::uint32_t>(words, 10);
  append<std::uint32_t>(words, 4000000000U);
  CHECK_THAT(pcd_error(words + "0123456789"), has("expected 120 from the header"));
  words = header("10", "binary_compressed");
  append<std::uint32_t>(words, 10);
  append<std::uint32_t>(words, 120);
  CHECK_THAT(pcd_error(words + "\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff"), has("damaged"));
  const std::string wide =
      "FIELDS x y z h\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 4294967296\nPOINTS ";
  CHECK_THAT(pcd_error(wide + "0\nDATA ascii\n") + "(no error)", has("(no error)"));
  CHECK_THAT(pcd_error(wide + "1\nDATA ascii\n1 2 3 4\n"), has("claims 1 points"));
  CHECK_THAT(pcd_error(wide + "1\nDATA binary\n1 2 3 4\n"), has("claims 1 points"));
  CHECK_THAT(pcd_error(wide + "4294967296\nDATA binary_compressed\n1 2 3 4\n"), has("claims"));
}

TEST_CASE("PCD: headers that contradict themselves", "[load][pcd]") {
  CHECK_THAT(pcd_error("ply\nformat"), has("not a PCD file: starts with 'ply\\x0aformat'"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nSIZE 4 4\n"), has("line 3: fewer values"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4 4\n"), has("line 3: more values"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y x\n"), has("a second field 'x'"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n"), has("field z"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 3\nPOINTS 1\nDATA ascii\n"),
             has("field 'z' type F and size 3"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nWIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA ascii\n"),
             has("POINTS 5, WIDTH x HEIGHT 4"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nWIDTH 4294967295\nHEIGHT 4294967295\n"
                       "DATA ascii\n"),
             has("more than 2^32 points"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nDATA ascii\n1 2 3\n"), has("neither POINTS"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\n"), has("no DATA"));
  CHECK_THAT(pcd_error("VERSION 0.7\nDATA ascii\n"), has("DATA before FIELDS"));
  CHECK_THAT(pcd_error("VERSION 0.7\nFIELDS x y z\nDATA gzip\n"), has("found 'gzip'"));
}

TEST_CASE("PCD: damage in ascii data names its line", "[load][pcd]") {
  const std::string head = header("2", "ascii");  // 11 lines
  CHECK_THAT(pcd_error(head + "1.5 2.5 3\n4 5\n"), has("line 13: ends where"));
  CHECK_THAT(pcd_error(head + "1 2 3\n4 5 6 7\n"), has("line 13: more than 3 values"));
  CHECK_THAT(pcd_error(head + "1 2 3          \n"),
             has("ends after line 12, expected point 2 of 2"));
  CHECK_THAT(pcd_error(head + "1 2 3\n4 5 6\n7 8 9\n"), has("line 14: more in the file"));
}

}  // namespace posevote::read_pcd_test
