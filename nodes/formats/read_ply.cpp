// SPDX-License-Identifier: BSD-3-Clause
// Reads PLY (Turk 1994): ascii and binary of both byte orders. Own code because PCL's reader trusts
// the header's counts and is some ten times slower.
//
// A row of a text file is one line. Elements other than vertex and face are skipped, and so are
// properties that are not needed. Polygons become fans of triangles. Colours are those of vertices,
// or of the images that comments name ("TextureFile"): places in them stand with the vertices, or
// with the faces (texcoord, as MeshLab writes them).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/ply_columns.hpp"
#include "nodes/formats/ply_rows.hpp"
#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {
namespace {

template <class Rows>
std::uint64_t list_length(Rows& in, const PlyProperty& list) {
  const double length = in.value(*list.count_type);
  if (!(length >= 0 && length < 4294967296.0 && length == std::floor(length)))
    in.fail("a list of length " + std::to_string(length));
  return static_cast<std::uint64_t>(length);
}

template <class Rows>
void skip_property(Rows& in, const PlyProperty& property) {
  in.skip(property.type, property.count_type ? list_length(in, property) : 1);
}

template <class Rows>
void read_vertices(Rows& in, const PlyElement& vertex, RawMesh& mesh) {
  const PlyColumns columns = find_columns(vertex);
  const auto pick = [](const std::vector<double>& row, const std::array<std::size_t, 3>& at) {
    return Triple{row[at[0]], row[at[1]], row[at[2]]};
  };
  mesh.points.reserve(vertex.count);
  if (columns.normal) mesh.normals.reserve(vertex.count);
  if (columns.color) mesh.colors.reserve(vertex.count);
  mesh.color_doubt = columns.color_doubt;
  std::vector<double> row(vertex.properties.size());
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    in.begin_row(vertex, i);
    for (std::size_t p = 0; p < row.size(); ++p) {
      const PlyProperty& property = vertex.properties[p];
      if (property.count_type)
        skip_property(in, property);
      else
        row[p] = in.value(property.type);
    }
    in.end_row();
    mesh.points.push_back(pick(row, columns.point));
    if (columns.normal) mesh.normals.push_back(pick(row, *columns.normal));
    if (columns.color) mesh.colors.push_back(pick(row, *columns.color));
    if (columns.place)
      mesh.paint.places.push_back({row[(*columns.place)[0]], row[(*columns.place)[1]]});
  }
  for (Triple& color : mesh.colors)
    for (double& value : color) value /= columns.brightest;
  mesh.settle_colors();
}

template <class Rows>
void read_polygon(Rows& in, const PlyProperty& list, std::uint64_t vertices,
                  std::vector<std::uint32_t>& polygon) {
  polygon.clear();
  const std::uint64_t length = list_length(in, list);
  for (std::uint64_t i = 0; i < length; ++i) {
    const double index = in.value(list.type);
    if (const std::string problem = index_problem(index, vertices); !problem.empty())
      in.fail(problem);
    polygon.push_back(static_cast<std::uint32_t>(index));
  }
}

/// The places of a face's corners in an image: a list of u, v, u, v ...
template <class Rows>
void read_places(Rows& in, const PlyProperty& list, RawMesh& mesh,
                 std::vector<std::uint32_t>& places) {
  places.clear();
  const std::uint64_t length = list_length(in, list);
  for (std::uint64_t i = 0; i + 1 < length; i += 2) {
    places.push_back(static_cast<std::uint32_t>(mesh.paint.places.size()));
    const double u = in.value(list.type), v = in.value(list.type);
    mesh.paint.places.push_back({u, v});
  }
  in.skip(list.type, length % 2);
}

template <class Rows>
void read_faces(Rows& in, const PlyElement& face, std::uint64_t vertices, RawMesh& mesh) {
  const PlyFaceColumns columns = find_face_columns(face);
  mesh.faces.reserve(face.count);
  std::vector<std::uint32_t> polygon, places;
  for (std::uint64_t i = 0; i < face.count; ++i) {
    in.begin_row(face, i);
    double image = 0;
    for (std::size_t p = 0; p < face.properties.size(); ++p) {
      if (p == columns.corners)
        read_polygon(in, face.properties[p], vertices, polygon);
      else if (p == columns.places)
        read_places(in, face.properties[p], mesh, places);
      else if (p == columns.image)
        image = in.value(face.properties[p].type);
      else
        skip_property(in, face.properties[p]);
    }
    in.end_row();
    if (columns.places < face.properties.size()) {
      if (places.size() != polygon.size())
        in.fail("texcoord has " + std::to_string(places.size()) + " places for " +
                std::to_string(polygon.size()) + " corners");
      mesh.add_polygon(polygon, places, static_cast<std::uint32_t>(std::clamp(image, 0.0, 1e6)));
    } else {
      mesh.add_polygon(polygon);
    }
  }
}

/// Images are of use where points or faces say their places in them. Those of points are each its
/// own corners'.
void settle_paint(RawMesh& mesh, const std::vector<std::string>& images) {
  Paint& paint = mesh.paint;
  if (paint.corners.empty() && paint.places.size() == mesh.points.size()) {
    paint.corners = mesh.faces;
    paint.material_of.assign(mesh.faces.size(), 0);
  }
  const bool is_used = paint.corners.size() == mesh.faces.size() && !mesh.faces.empty();
  if (!is_used || images.empty()) {
    paint = {};
    return;
  }
  const std::uint32_t last = *std::max_element(paint.material_of.begin(), paint.material_of.end());
  if (last < images.size()) {
    paint.materials = images;
    return;
  }
  paint = {};
  mesh.color_doubt = "a face refers to image " + std::to_string(std::uint64_t{last} + 1) +
                     ", the file has " + std::to_string(images.size());
}

template <class Rows>
RawMesh read_body(Rows in, const PlyHeader& header, std::uint64_t vertices) {
  RawMesh mesh;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      read_vertices(in, element, mesh);
    } else if (element.name == "face") {
      read_faces(in, element, vertices, mesh);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        in.begin_row(element, i);
        for (const PlyProperty& property : element.properties) skip_property(in, property);
        in.end_row();
      }
    }
  }
  in.end_file();
  settle_paint(mesh, header.images);
  return mesh;
}

RawMesh read_ply(std::string_view bytes) {
  TextScanner in(bytes);
  if (!in.next_line() || in.word() != "ply" || !in.line_done())
    throw std::runtime_error("not a PLY file: starts with " + in_quotes(bytes));
  const PlyHeader header = read_ply_header(in);
  const PlyElement* vertex = header.find("vertex");
  if (!vertex) throw std::runtime_error("the PLY header names no element vertex");
  find_columns(*vertex);  // complains about the header before the room does
  const std::size_t body = in.next_offset();
  check_ply_room(header, bytes.size() - body);
  if (header.format == PlyFormat::kAscii) return read_body(AsciiRows(in), header, vertex->count);
  const bool little = header.format == PlyFormat::kLittleEndian;
  const BinaryRows rows(bytes, body, little ? std::endian::little : std::endian::big);
  return read_body(rows, header, vertex->count);
}

const auto registered = register_format("PLY", {".ply"}, read_ply);

}  // namespace
}  // namespace posevote::formats
