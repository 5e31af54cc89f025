// SPDX-License-Identifier: BSD-3-Clause
// The header of a PLY file: which elements follow, in which order, and of what their rows consist.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nodes/formats/text_scanner.hpp"

namespace posevote::formats {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of one value in a binary file.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Position of a property, if there is one of that name.
  std::optional<std::size_t> find(const std::string& property) const;
  /// "vertices", "faces", "edges"
  std::string plural() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::vector<std::string> images;  ///< of "comment TextureFile NAME"

  /// Null where there is none.
  const PlyElement* find(const std::string& element) const;
};

/// Leaves `in` at the line "end_header". Throws std::runtime_error with the line that is wrong.
PlyHeader read_ply_header(TextScanner& in);

/// Throws std::runtime_error where the elements cannot fit into the `room` bytes after the header.
void check_ply_room(const PlyHeader& header, std::uint64_t room);

}  // namespace posevote::formats
