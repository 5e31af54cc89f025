// SPDX-License-Identifier: BSD-3-Clause
// Reads Wavefront OBJ: v, vn and f (v, v/vt, v//vn, v/vt/vn; negative indices count from the
// latest), and where colours are: behind a vertex, or vt, mtllib and usemtl. Groups and objects are
// skipped: all faces are one mesh. A vertex whose corners have different normals gets their mean. Without faces that name normals, as many vn
// as v belong to the vertices in order (point clouds are written so).
//
// Own code because assimp 5.2 takes 584 ms and PCL 1.13 585 for the 320 000 triangles that take 52
// here; of 1000 damaged files they crash on 1 and 7, PCL's faces refer to vertices that are not
// there (183), assimp cuts a concave polygon wrongly, and neither names a line.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/raw_mesh.hpp"
#include "nodes/formats/text_scanner.hpp"

namespace posevote::formats {
namespace {

/// Keywords of the format that say nothing about points and triangles.
bool is_skipped(std::string_view keyword) {
  constexpr std::array<std::string_view, 37> kSkipped{
      "vp",     "g",      "o",      "s",          "l",         "p",     "mg",    "bevel",
      "lod",    "maplib", "usemap", "c_interp",   "d_interp",  "deg",   "bmat",  "step",
      "cstype", "curv",   "curv2",  "surf",       "parm",      "trim",  "hole",  "scrv",
      "sp",     "end",    "con",    "shadow_obj", "trace_obj", "ctech", "stech", "bzp",
      "bsp",    "cdc",    "cdp",    "res",        "call"};
  return std::find(kSkipped.begin(), kSkipped.end(), keyword) != kSkipped.end();
}

/// The largest index used and the line of its first use: a face may precede its vertices.
struct LargestIndex {
  std::uint32_t index = 0;
  std::size_t line = 0;

  void use(std::uint32_t used, std::size_t at_line) {
    if (line == 0 || used > index) *this = {used, at_line};
  }
  void check(std::size_t count, const std::string& what) const {
    if (line > 0 && index >= count)
      throw std::runtime_error("line " + std::to_string(line) + ": a face refers to " + what + " " +
                               std::to_string(std::uint64_t{index} + 1) + ", the file has " +
                               std::to_string(count));
  }
};

constexpr std::uint32_t kNoPlace = std::numeric_limits<std::uint32_t>::max();

class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : in_(bytes, '#') {}

  RawMesh read() {
    while (in_.next_line()) {
      const std::string_view keyword = in_.word();
      if (keyword == "v")
        read_vertex();
      else if (keyword == "vt")
        mesh_.paint.places.push_back(read_place());
      else if (keyword == "usemtl")
        use_material(in_.rest_of_line());
      else if (keyword == "mtllib")
        mesh_.paint.libraries.push_back(in_.rest_of_line());
      else if (keyword == "vn")
        normals_.push_back(read_triple());
      else if (keyword == "f")
        read_face();
      else if (!is_skipped(keyword))
        in_.fail("expected a line of an OBJ file, found " + in_quotes(keyword));
    }
    largest_vertex_.check(mesh_.points.size(), "vertex");
    largest_normal_.check(normals_.size(), "normal");
    assign_normals();
    settle_colors();
    return std::move(mesh_);
  }

 private:
  Triple read_triple() {
    Triple triple;
    for (double& coordinate : triple) coordinate = in_.number();
    return triple;
  }

  /// A weight or a colour may follow, by how many numbers there are.
  void read_vertex() {
    mesh_.points.push_back(read_triple());
    Triple color{};
    std::size_t more = 0;
    for (; !in_.line_done(); ++more) {
      const double value = in_.number();
      if (more < 3) color[more] = value;
    }
    if (more == 3) mesh_.colors.push_back(color);
  }

  std::array<double, 2> read_place() {
    std::array<double, 2> place{in_.number(), 0};
    if (!in_.line_done()) place[1] = in_.number();
    while (!in_.line_done()) in_.number();  // a depth
    return place;
  }

  void use_material(const std::string& name) {
    std::vector<std::string>& names = mesh_.paint.materials;
    const auto known = std::find(names.begin(), names.end(), name);
    material_ = static_cast<std::uint32_t>(known - names.begin());
    if (known == names.end()) names.push_back(name);
  }

  /// An index of a face's corner, counted from 0.
  std::uint32_t read_index(std::string_view text, std::size_t count, LargestIndex& largest) {
    const std::optional<std::int64_t> index = to_integer(text);
    const auto so_far = static_cast<std::int64_t>(count);
    if (!index || *index == 0 || *index < -so_far || *index > (std::int64_t{1} << 32) - 1)
      in_.fail("expected an index from 1, or down to -" + std::to_string(count) + ", found " +
               in_quotes(text));
    const auto zero_based = static_cast<std::uint32_t>(*index > 0 ? *index - 1 : so_far + *index);
    largest.use(zero_based, in_.line());
    return zero_based;
  }

  /// What is wrong with it costs the colours alone.
  std::uint32_t read_place_index(std::string_view text) {
    const auto so_far = static_cast<std::int64_t>(mesh_.paint.places.size());
    const std::int64_t index = to_integer(text).value_or(0);
    if (index == 0 || index < -so_far || index >= kNoPlace) {
      wrong_place_ = text;
      return kNoPlace;
    }
    const auto zero_based = static_cast<std::uint32_t>(index > 0 ? index - 1 : so_far + index);
    most_place_ = std::max(most_place_, std::size_t{zero_based} + 1);
    return zero_based;
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void read_corner(std::string_view corner) {
    const std::size_t slash = std::min(corner.find('/'), corner.size());
    polygon_.push_back(read_index(corner.substr(0, slash), mesh_.points.size(), largest_vertex_));
    places_.push_back(kNoPlace);
    if (slash == corner.size()) return;
    const std::size_t second = std::min(corner.find('/', slash + 1), corner.size());
    const std::string_view place = corner.substr(slash + 1, second - slash - 1);
    if (!place.empty()) places_.back() = read_place_index(place);
    if (second == corner.size()) return;
    const std::uint32_t normal =
        read_index(corner.substr(second + 1), normals_.size(), largest_normal_);
    corner_normals_.emplace_back(polygon_.back(), normal);
  }

  void read_face() {
    polygon_.clear();
    places_.clear();
    while (!in_.line_done()) {
      const std::string_view corner = in_.word();
      if (corner == "\\" && in_.line_done()) {  // the face goes on in the next line
        if (!in_.next_line()) in_.fail("the file ends within a face");
        continue;
      }
      read_corner(corner);
    }
    if (polygon_.size() < 3) in_.fail("a face needs three corners or more");
    if (mesh_.paint.materials.empty()) use_material("");
    mesh_.add_polygon(polygon_, places_, material_);
  }

  void settle_colors() {
    Paint& paint = mesh_.paint;
    if (most_place_ > paint.places.size()) wrong_place_ = std::to_string(most_place_);
    if (!paint.libraries.empty() && !wrong_place_.empty())
      mesh_.color_doubt = "a face refers to texture vertex " + wrong_place_ + ", the file has " +
                          std::to_string(paint.places.size());
    if (paint.libraries.empty() || !wrong_place_.empty()) paint = {};
    mesh_.settle_colors();
  }

  void assign_normals() {
    if (corner_normals_.empty()) {
      if (normals_.size() == mesh_.points.size()) mesh_.normals = std::move(normals_);
      return;
    }
    mesh_.normals.assign(mesh_.points.size(), Triple{});
    for (const auto& [vertex, normal] : corner_normals_)
      for (std::size_t i = 0; i < 3; ++i) mesh_.normals[vertex][i] += normals_[normal][i];
  }

  TextScanner in_;
  RawMesh mesh_;
  std::vector<Triple> normals_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corner_normals_;  ///< vertex, normal
  LargestIndex largest_vertex_, largest_normal_;
  std::vector<std::uint32_t> polygon_, places_;
  std::uint32_t material_ = 0;  ///< of the faces that follow
  std::size_t most_place_ = 0;
  std::string wrong_place_;  ///< a texture vertex that is none
};

RawMesh read_obj(std::string_view bytes) { return ObjReader(bytes).read(); }

const auto registered = register_format("OBJ", {".obj"}, read_obj);

}  // namespace
}  // namespace posevote::formats
