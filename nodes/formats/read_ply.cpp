// SPDX-License-Identifier: BSD-3-Clause
// Reads PLY (Turk 1994): ascii and binary of both byte orders. Own code because PCL's reader trusts
// the header's counts and is some ten times slower.
//
// A row of a text file is one line. Elements other than vertex and face are skipped, and so are
// properties that are not needed. Polygons become fans of triangles.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/ply_header.hpp"
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

/// Positions of x, y, z, and of nx, ny, nz where there are all three.
struct VertexColumns {
  std::array<std::size_t, 3> point{};
  std::array<std::size_t, 3> normal{};
  bool has_normals = true;
};

VertexColumns find_columns(const PlyElement& vertex) {
  VertexColumns columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    const auto point = vertex.find(axis);
    const auto normal = vertex.find("n" + axis);
    if (!point || vertex.properties[*point].count_type)
      throw std::runtime_error("the header's vertex has no property " + axis +
                               ", expected x, y and z");
    columns.point[i] = *point;
    if (normal && !vertex.properties[*normal].count_type)
      columns.normal[i] = *normal;
    else
      columns.has_normals = false;
  }
  return columns;
}

template <class Rows>
void read_vertices(Rows& in, const PlyElement& vertex, RawMesh& mesh) {
  const VertexColumns columns = find_columns(vertex);
  const auto pick = [](const std::vector<double>& row, const std::array<std::size_t, 3>& at) {
    return Triple{row[at[0]], row[at[1]], row[at[2]]};
  };
  mesh.points.reserve(vertex.count);
  if (columns.has_normals) mesh.normals.reserve(vertex.count);
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
    if (columns.has_normals) mesh.normals.push_back(pick(row, columns.normal));
  }
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

template <class Rows>
void read_faces(Rows& in, const PlyElement& face, std::uint64_t vertices, RawMesh& mesh) {
  const auto indices = face.find("vertex_indices");
  const std::size_t list = indices ? *indices : face.find("vertex_index").value_or(SIZE_MAX);
  if (list < face.properties.size() && !face.properties[list].count_type)
    throw std::runtime_error("the header's face has vertex indices that are not a list");
  mesh.faces.reserve(face.count);
  std::vector<std::uint32_t> polygon;
  for (std::uint64_t i = 0; i < face.count; ++i) {
    in.begin_row(face, i);
    for (std::size_t p = 0; p < face.properties.size(); ++p) {
      if (p == list)
        read_polygon(in, face.properties[p], vertices, polygon);
      else
        skip_property(in, face.properties[p]);
    }
    in.end_row();
    mesh.add_polygon(polygon);
  }
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
