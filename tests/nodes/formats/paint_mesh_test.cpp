// SPDX-License-Identifier: BSD-3-Clause
// Colours of models and scans, from whatever file says them.
#include "nodes/formats/paint_mesh.hpp"

#include "nodes/color/texture_color.hpp"
#include "nodes/formats/paint_files.hpp"
#include "nodes/formats/read_scan.hpp"
#include "tests/nodes/formats/support.hpp"

namespace posevote::paint_mesh_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

/// Red, green; blue, white.
std::string four_colours() {
  return png_bytes(2, 2, 8, 3, std::string("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff", 12));
}

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
/// Two faces, of which the second has point 1 elsewhere in the image.
const std::string kSeam = "vt 0.2 0.2\nvt 0.8 0.2\nvt 0.8 0.8\nvt 0.2 0.8\n" + kVertices +
                          "usemtl printed\nf 1/1 2/2 3/3\nf 1/4 3/3 4/4\n";
const std::string kLibrary = "# made by hand\nnewmtl printed\nKd 1 1 1\nmap_Kd four colours.png\n";

struct Loaded {
  Mesh mesh;
  std::string warning;
};

Loaded load(const std::filesystem::path& file) {
  Loaded loaded;
  loaded.mesh = read_mesh(file, 1, [&](const std::string& what) { loaded.warning = what; });
  return loaded;
}

}  // namespace

TEST_CASE("OBJ: a texture; what lies on its seam is several points", "[load][obj][color]") {
  const TempDir dir;
  dir.write("four colours.png", four_colours());
  dir.write("a.mtl", kLibrary);
  const auto file = dir.write("a.obj", "mtllib a.mtl\n" + kSeam);
  const Loaded loaded = load(file);
  CHECK(loaded.warning.empty());
  REQUIRE(loaded.mesh.texture);
  CHECK(loaded.mesh.points.rows() == 5);
  CHECK(loaded.mesh.points.row(4) == loaded.mesh.points.row(0));
  CHECK(loaded.mesh.faces(1, 0) == 4);
  const ColorMatrix colors = color::point_colors(loaded.mesh);
  CHECK(colors.row(0) == Eigen::RowVector3f(0, 0, 1));
  CHECK(colors.row(2) == Eigen::RowVector3f(0, 1, 0));
  CHECK(colors.row(4) == Eigen::RowVector3f(1, 0, 0));

  const Scan scan = read_scan(file, 1);  // of a scan each point has one colour
  CHECK(scan.points.rows() == 4);
  CHECK_FALSE(scan.texture);
  CHECK(scan.colors.row(0) == Eigen::RowVector3f(0, 0, 1));
}

TEST_CASE("OBJ: materials of one colour", "[load][obj][color]") {
  const TempDir dir;
  dir.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
  const Loaded loaded = load(dir.write(
      "a.obj", "mtllib a.mtl\n" + kVertices + "usemtl red\nf 1 2 3\nusemtl green\nf 1 3 4\n"));
  REQUIRE(loaded.mesh.texture);
  CHECK(loaded.mesh.points.rows() == 6);
  const ColorMatrix colors = color::point_colors(loaded.mesh);
  CHECK(colors.row(1) == Eigen::RowVector3f(1, 0, 0));
  CHECK(colors.row(3) == Eigen::RowVector3f(0, 1, 0));
}

TEST_CASE("colours that cannot be had are left out, and named", "[load][color]") {
  const TempDir dir;
  const auto file = dir.write("a.obj", "mtllib a.mtl\n" + kSeam);
  const auto refused = [&](const std::string& what) {
    const Loaded loaded = load(file);
    CHECK_THAT(loaded.warning, has("its colours are left out: ") && has(what));
    CHECK_FALSE(color::is_colored(loaded.mesh));
    CHECK(loaded.mesh.points.rows() == 4);
    CHECK(loaded.mesh.faces.rows() == 2);
  };
  refused("a.mtl");
  dir.write("a.mtl", kLibrary);
  refused("four colours.png");
  dir.write("four colours.png", four_colours().substr(0, 40));
  refused("four colours.png: damaged PNG file");
  dir.write("a.mtl", "newmtl other\nKd 1 0 0\n");
  refused("no library says what material 'printed' is");
  dir.write("a.mtl", "Kd 1 0 0\n");
  refused("a.mtl: line 1: a colour before the first material");
}

TEST_CASE("OBJ: a texture vertex that is not there costs the colours alone", "[load][obj][color]") {
  for (const std::string place : {"3", "-9", "x"}) {
    const RawMesh mesh =
        read_raw(".obj", "mtllib a.mtl\nvt 0 0\n" + kVertices + "f 1/1 2/" + place + " 3/1\n");
    CHECK(mesh.faces.size() == 1);
    CHECK(mesh.paint.materials.empty());
    CHECK_THAT(mesh.color_doubt, has("a face refers to texture vertex " + place));
  }
}

TEST_CASE("OBJ: colours behind the vertices", "[load][obj][color]") {
  const RawMesh all = read_raw(".obj", "v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\n");
  CHECK(all.colors == std::vector<Triple>{{1, 0, 0}, {0, 0.5, 0}});
  const RawMesh bytes = read_raw(".obj", "v 0 0 0 255 0 51\nv 1 0 0 0 0 0\n");
  CHECK(bytes.colors[0] == Triple{1, 0, 0.2});
  const RawMesh some = read_raw(".obj", "v 0 0 0 1 0 0\nv 1 0 0\n");
  CHECK(some.colors.empty());
  CHECK(some.color_doubt == "1 of 2 points have a colour");
  CHECK(read_raw(".obj", "v 0 0 0 1\n").colors.empty());  // a weight
}

TEST_CASE("PLY: colours of vertices, as bytes or shares", "[load][ply][color]") {
  const auto ply = [](const std::string& type, const std::string& names, const std::string& row) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
        "y\nproperty float z\n";
    for (const char name : names)
      text += "property " + type + " " +
              (name == 'r'   ? "red"
               : name == 'g' ? "green"
                             : "blue") +
              "\n";
    return read_raw(".ply", text + "end_header\n1 2 3 " + row + "\n");
  };
  CHECK(ply("uchar", "rgb", "255 0 51").colors == std::vector<Triple>{{1, 0, 0.2}});
  CHECK(ply("uchar", "bgr", "255 0 51").colors == std::vector<Triple>{{0.2, 0, 1}});
  CHECK(ply("float", "rgb", "1 0 0.2").colors == std::vector<Triple>{{1, 0, 0.2}});
  CHECK(ply("uchar", "rgb", "1 0 1").colors[0][0] == Approx(1 / 255.0));
  CHECK(ply("uchar", "rg", "255 0").colors.empty());
  CHECK_THAT(ply("uchar", "rg", "255 0").color_doubt, has("not all of red, green and blue"));
}

TEST_CASE("PLY: textures by vertex and by face", "[load][ply][color]") {
  const TempDir dir;
  dir.write("four.png", four_colours());
  const std::string head =
      "ply\nformat ascii 1.0\ncomment TextureFile four.png\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const Loaded by_vertex = load(
      dir.write("a.ply", head + "property float texture_u\nproperty float texture_v\n" + face +
                             "end_header\n0 0 0 0.2 0.2\n1 0 0 0.8 0.2\n0 1 0 0.2 0.8\n3 0 1 2\n"));
  REQUIRE(by_vertex.mesh.texture);
  const ColorMatrix colors = color::point_colors(by_vertex.mesh);
  CHECK(colors.row(0) == Eigen::RowVector3f(0, 0, 1));
  CHECK(colors.row(2) == Eigen::RowVector3f(1, 0, 0));
  const std::string by_face = head + face +
                              "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n"
                              "0 1 0\n3 0 1 2 ";
  const Loaded faces = load(dir.write("b.ply", by_face + "6 0.2 0.2 0.8 0.2 0.2 0.8\n"));
  REQUIRE(faces.mesh.texture);
  CHECK(color::point_colors(faces.mesh) == colors);
  CHECK_THAT(error_of([&] { load(dir.write("c.ply", by_face + "4 0.2 0.2 0.8 0.2\n")); }),
             has("texcoord has 2 places for 3 corners"));
}

TEST_CASE("PCD and OFF: colours", "[load][pcd][off][color]") {
  const std::string head = "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F ";
  const std::string rest = "\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ";
  const std::uint32_t orange = 0xFF8000U;
  CHECK(read_raw(".pcd", head + "U" + rest + "ascii\n1 2 3 16744448\n").colors[0] ==
        Triple{1, 128 / 255.0, 0});
  std::string binary = head + "F" + rest + "binary\n";
  for (const float value : {1.0F, 2.0F, 3.0F}) append(binary, value);
  append(binary, orange);
  CHECK(read_raw(".pcd", binary).colors == std::vector<Triple>{{1, 128 / 255.0, 0}});
  CHECK(read_raw(".off", "COFF\n1 0 0\n1 2 3 255 0 51 255\n").colors ==
        std::vector<Triple>{{1, 0, 0.2}});
  CHECK(read_raw(".off", "COFF\n2 0 0\n1 2 3 255 0 51 255\n1 2 4\n").color_doubt ==
        "1 of 2 points have a colour");
}

TEST_CASE("the files that a mesh's colours are in are found without its points", "[load][color]") {
  const TempDir dir;
  const auto names = [&](const std::string& mesh) {
    std::vector<std::string> found;
    for (const auto& file : paint_files(dir.path(mesh))) found.push_back(file.filename().string());
    return found;
  };
  using Names = std::vector<std::string>;
  dir.write("box.obj", "o box\n  mtllib of a box.mtl\n# mtllib of no box.mtl\n" + kVertices);
  CHECK(names("box.obj").empty());
  dir.write("of a box.mtl", kLibrary);
  CHECK(names("box.obj") == Names{"of a box.mtl"});
  dir.write("four colours.png", four_colours());
  CHECK(names("box.obj") == Names{"of a box.mtl", "four colours.png"});
  dir.write("of a box.mtl", "map_Kd nothing\n");  // no material: its reader will say so
  CHECK(names("box.obj") == Names{"of a box.mtl"});
  dir.write("box.ply", "ply\nformat ascii 1.0\ncomment TextureFile four colours.png\nend_header\n");
  CHECK(names("box.ply") == Names{"four colours.png"});
  dir.write("torn.ply", "ply\nformat");
  CHECK(names("torn.ply").empty());
  CHECK(names("none.ply").empty());
  CHECK(names("box.stl").empty());
}

}  // namespace posevote::paint_mesh_test
