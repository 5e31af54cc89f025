// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/ply_header.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {
namespace {

/// Of elements, and of properties of an element: real files have some ten, and names are searched.
constexpr std::size_t kMostEntries = 1000;

PlyType read_type(TextScanner& in) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames{
      {{"char", PlyType::kInt8},
       {"int8", PlyType::kInt8},
       {"uchar", PlyType::kUint8},
       {"uint8", PlyType::kUint8},
       {"short", PlyType::kInt16},
       {"int16", PlyType::kInt16},
       {"ushort", PlyType::kUint16},
       {"uint16", PlyType::kUint16},
       {"int", PlyType::kInt32},
       {"int32", PlyType::kInt32},
       {"uint", PlyType::kUint32},
       {"uint32", PlyType::kUint32},
       {"float", PlyType::kFloat32},
       {"float32", PlyType::kFloat32},
       {"double", PlyType::kFloat64},
       {"float64", PlyType::kFloat64}}};
  const std::string_view word = in.word();
  for (const auto& [name, type] : kNames)
    if (name == word) return type;
  in.fail("expected a type such as float or uchar, found " + in_quotes(word));
}

PlyFormat read_format(TextScanner& in) {
  const std::string_view word = in.word();
  if (word == "ascii") return PlyFormat::kAscii;
  if (word == "binary_little_endian") return PlyFormat::kLittleEndian;
  if (word == "binary_big_endian") return PlyFormat::kBigEndian;
  in.fail("expected format ascii, binary_little_endian or binary_big_endian, found " +
          in_quotes(word));
}

/// Names of elements appear in messages, which must stay short and printable.
bool is_plain_name(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  return !name.empty() && name.size() <= kLongest &&
         std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
}

PlyElement read_element(TextScanner& in, const PlyHeader& header) {
  PlyElement element;
  element.name = in.word();
  if (!is_plain_name(element.name)) in.fail("an element of the name " + in_quotes(element.name));
  if (header.elements.size() == kMostEntries) in.fail("too many elements");
  if (header.find(element.name)) in.fail("a second element " + in_quotes(element.name));
  element.count = read_count(in, element.plural());
  return element;
}

void read_property(TextScanner& in, PlyHeader& header) {
  if (header.elements.empty()) in.fail("a property before the first element");
  PlyElement& element = header.elements.back();
  PlyProperty property;
  TextScanner list = in;
  if (list.word() == "list") {
    in = list;
    property.count_type = read_type(in);
    if (*property.count_type >= PlyType::kFloat32)
      in.fail("the length of a list must be of an integer type");
  }
  property.type = read_type(in);
  property.name = in.word();
  if (property.name.empty()) in.fail("a property without a name");
  if (element.properties.size() == kMostEntries) in.fail("too many properties");
  if (element.find(property.name)) in.fail("a second property " + in_quotes(property.name));
  element.properties.push_back(std::move(property));
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> PlyElement::find(const std::string& property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return i;
  return std::nullopt;
}

std::string PlyElement::plural() const { return name == "vertex" ? "vertices" : name + "s"; }

const PlyElement* PlyHeader::find(const std::string& element) const {
  const auto at = std::find_if(elements.begin(), elements.end(),
                               [&](const PlyElement& e) { return e.name == element; });
  return at == elements.end() ? nullptr : &*at;
}

PlyHeader read_ply_header(TextScanner& in) {
  PlyHeader header;
  bool has_format = false;
  while (in.next_line()) {
    const std::string_view keyword = in.word();
    if (keyword == "end_header") {
      if (!has_format) in.fail("the header ends without a format");
      return header;
    }
    if (keyword == "format") {
      header.format = read_format(in);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(in, header));
    } else if (keyword == "property") {
      read_property(in, header);
    } else if (keyword == "comment") {
      if (in.word() == "TextureFile") header.images.push_back(in.rest_of_line());
    } else if (keyword != "obj_info") {
      in.fail("expected a line of a PLY header, found " + in_quotes(keyword));
    }
  }
  in.fail("the file ends within the header: no end_header");
}

void check_ply_room(const PlyHeader& header, std::uint64_t room) {
  const bool ascii = header.format == PlyFormat::kAscii;
  if (ascii) ++room;  // the last value of a text needs no blank behind it
  for (const PlyElement& element : header.elements) {
    std::uint64_t row = 0;  // the least bytes of a row: all lists empty, each number one digit
    for (const PlyProperty& property : element.properties)
      row += ascii ? 2 : size_of(property.count_type.value_or(property.type));
    check_room(element.count, element.plural(), row, room);
    room -= element.count * row;
  }
}

}  // namespace posevote::formats
