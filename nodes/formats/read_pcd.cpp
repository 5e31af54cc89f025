// SPDX-License-Identifier: BSD-3-Clause
// Reads PCD (PCL's format): ascii, binary and binary_compressed. Of PCL only the decompressor is
// used: PCL 1.13's reader crashes on 216 of 1000 damaged files, allocates what a lying header asks
// for, needs its global console silenced (for every thread of the process) not to print, and takes
// 127 ms where this takes 17 (ascii).
//
// VIEWPOINT's translation becomes the view's origin; its rotation says nothing about the points.
#include <liblzf/lzf.h>

#include <bit>
#include <stdexcept>
#include <utility>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/pcd_header.hpp"
#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {
namespace {

/// One of x, y, z, normal_x, normal_y, normal_z, rgb: where its values are.
struct Column {
  PcdField field;
  std::uint64_t value = 0;   ///< ascii: position in the line
  std::uint64_t offset = 0;  ///< binary: byte of the first point's value
  std::uint64_t stride = 0;  ///< binary: bytes from point to point
};

using Columns = std::array<Column, 3>;

/// Nothing where there is none. Compressed data holds field after field (all x, then all y, ...)
/// without the padding fields "_"; else it holds point after point.
std::optional<Column> find_column(const PcdHeader& header, const std::string& name) {
  const bool planar = header.data == PcdData::kBinaryCompressed;
  const auto at = header.find(name);
  if (!at || header.fields[*at].count != 1) return std::nullopt;
  Column column;
  column.field = header.fields[*at];
  column.stride = planar ? column.field.size : header.point_bytes();
  for (std::size_t f = 0; f < *at; ++f) {
    const PcdField& before = header.fields[f];
    column.value += before.count;
    if (!planar)
      column.offset += before.bytes();
    else if (before.name != "_")
      column.offset += before.bytes() * header.points;
  }
  return column;
}

/// Nothing where one of the three is missing.
std::optional<Columns> find_columns(const PcdHeader& header, const std::string& prefix) {
  Columns columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = find_column(header, prefix + "xyz"[i]);
    if (!column) return std::nullopt;
    columns[i] = *column;
  }
  return columns;
}

/// Red, green and blue in the three low bytes of four, which may call themselves a float.
std::optional<Column> find_colors(const PcdHeader& header) {
  for (const char* name : {"rgb", "rgba"})
    if (const auto column = find_column(header, name); column && column->field.size == 4)
      return column;
  return std::nullopt;
}

Triple unpacked(std::uint32_t color) {
  return {(color >> 16 & 255U) / 255.0, (color >> 8 & 255U) / 255.0, (color & 255U) / 255.0};
}

/// As ascii has it: the number of those four bytes.
Triple written(double value, const PcdField& field) {
  if (field.type == 'F') return unpacked(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  const auto whole = value >= -2147483648.0 && value < 4294967296.0
                         ? static_cast<std::int64_t>(value)
                         : std::int64_t{0};
  return unpacked(static_cast<std::uint32_t>(whole));
}

template <class T>
double load_as(const char* bytes) {
  return static_cast<double>(load_bytes<T>(bytes));
}

double value_at(const char* bytes, const PcdField& field) {
  const bool is_signed = field.type == 'I', is_float = field.type == 'F';
  switch (field.size) {
    case 1:
      return is_signed ? load_as<std::int8_t>(bytes) : load_as<std::uint8_t>(bytes);
    case 2:
      return is_signed ? load_as<std::int16_t>(bytes) : load_as<std::uint16_t>(bytes);
    case 4:
      if (is_float) return load_as<float>(bytes);
      return is_signed ? load_as<std::int32_t>(bytes) : load_as<std::uint32_t>(bytes);
    default:
      if (is_float) return load_as<double>(bytes);
      return is_signed ? load_as<std::int64_t>(bytes) : load_as<std::uint64_t>(bytes);
  }
}

void read_binary(std::string_view data, const Columns& columns, std::uint64_t points,
                 std::vector<Triple>& out) {
  out.resize(points);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Column& column = columns[axis];
    for (std::uint64_t i = 0; i < points; ++i)
      out[i][axis] = value_at(data.data() + column.offset + i * column.stride, column.field);
  }
}

void read_colors(std::string_view data, const Column& column, std::uint64_t points,
                 std::vector<Triple>& out) {
  for (std::uint64_t i = 0; i < points; ++i)
    out.push_back(
        unpacked(load_bytes<std::uint32_t>(data.data() + column.offset + i * column.stride)));
}

/// What is read of a file.
struct WantedColumns {
  Columns points;
  std::optional<Columns> normals;
  std::optional<Column> color;
};

void read_ascii(TextScanner& in, std::uint64_t room, const PcdHeader& header,
                const WantedColumns& wanted, RawMesh& mesh) {
  if (header.points == 0) return;  // nothing then bounds the width
  const std::uint64_t width = header.point_values();
  check_room(header.points, "points", 2 * width, room + 1);
  std::vector<double> row(width);
  const auto pick = [&row](const Columns& columns) {
    return Triple{row[columns[0].value], row[columns[1].value], row[columns[2].value]};
  };
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (!in.next_line())
      throw std::runtime_error("the file ends after line " + std::to_string(in.line()) +
                               ", expected point " + std::to_string(i + 1) + " of " +
                               std::to_string(header.points));
    for (double& value : row) value = in.number();
    if (!in.line_done()) in.fail("more than " + std::to_string(width) + " values");
    mesh.points.push_back(pick(wanted.points));
    if (wanted.normals) mesh.normals.push_back(pick(*wanted.normals));
    if (wanted.color) mesh.colors.push_back(written(row[wanted.color->value], wanted.color->field));
  }
  if (in.next_line()) in.fail("more in the file than the header says");
}

/// Two words precede compressed data: its bytes, and what it unpacks to. Both are checked before
/// anything is allocated: LZF makes at most 264 bytes of 3.
std::vector<char> decompress(std::string_view data, const PcdHeader& header) {
  constexpr std::uint64_t kMostRatio = 88;
  check_room(header.points, "points", header.point_bytes(), kMostRatio * data.size());
  const std::uint64_t expected = header.points * header.point_bytes();
  constexpr std::size_t kWords = 2 * sizeof(std::uint32_t);
  if (data.size() < kWords)
    throw std::runtime_error("the file ends within the sizes of the compressed data");
  const auto packed = load_bytes<std::uint32_t>(data.data());
  const auto unpacked = load_bytes<std::uint32_t>(data.data() + sizeof(std::uint32_t));
  data.remove_prefix(kWords);
  check_room(packed, "bytes of compressed data", 1, data.size());
  if (!is_padding(data.substr(packed)))
    throw std::runtime_error("more in the file than the compressed data");
  if (unpacked != expected)
    throw std::runtime_error("compressed data unpacks to " + std::to_string(unpacked) +
                             " bytes, expected " + std::to_string(expected) + " from the header");
  check_room(unpacked, "unpacked bytes", 1, kMostRatio * packed);
  std::vector<char> out(unpacked);
  if (lzf_decompress(data.data(), packed, out.data(), unpacked) != unpacked)
    throw std::runtime_error("the compressed data is damaged");
  return out;
}

std::string_view plain_body(std::string_view body, const PcdHeader& header) {
  check_room(header.points, "points", header.point_bytes(), body.size());
  const std::uint64_t used = header.points * header.point_bytes();
  if (!is_padding(body.substr(used)))
    throw std::runtime_error(std::to_string(body.size() - used) +
                             " bytes more in the file than the header says");
  return body;
}

RawMesh read_pcd(std::string_view bytes) {
  TextScanner first(bytes, '#');
  const std::string_view keyword = first.next_line() ? first.word() : "";
  if (keyword != "VERSION" && keyword != "FIELDS" && keyword != "COLUMNS")
    throw std::runtime_error("not a PCD file: starts with " + in_quotes(bytes));
  TextScanner in(bytes, '#');
  const PcdHeader header = read_pcd_header(in);
  const std::string_view body = bytes.substr(in.next_offset());
  const WantedColumns wanted{find_columns(header, "").value(), find_columns(header, "normal_"),
                             find_colors(header)};
  RawMesh mesh;
  mesh.viewpoint = header.viewpoint;
  if (header.data == PcdData::kAscii) {
    read_ascii(in, body.size(), header, wanted, mesh);
    return mesh;
  }
  const bool packed = header.data == PcdData::kBinaryCompressed;
  const std::vector<char> unpacked = packed ? decompress(body, header) : std::vector<char>();
  const std::string_view data =
      packed ? std::string_view(unpacked.data(), unpacked.size()) : plain_body(body, header);
  read_binary(data, wanted.points, header.points, mesh.points);
  if (wanted.normals) read_binary(data, *wanted.normals, header.points, mesh.normals);
  if (wanted.color) read_colors(data, *wanted.color, header.points, mesh.colors);
  return mesh;
}

const auto registered = register_format("PCD", {".pcd"}, read_pcd);

}  // namespace
}  // namespace posevote::formats
