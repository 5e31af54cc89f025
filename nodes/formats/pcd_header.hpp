// SPDX-License-Identifier: BSD-3-Clause
// The header of a PCD file (PCL's format, version 0.7 and before).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nodes/formats/raw_mesh.hpp"
#include "nodes/formats/text_scanner.hpp"

namespace posevote::formats {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

struct PcdField {
  std::string name;
  char type = 'F';          ///< F, I or U
  std::size_t size = 4;     ///< bytes of one value
  std::uint64_t count = 1;  ///< values of the field in one point

  std::uint64_t bytes() const { return size * count; }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  PcdData data = PcdData::kAscii;
  Triple viewpoint{};  ///< origin of the sensor, in the frame of the points

  std::optional<std::size_t> find(const std::string& field) const;
  std::uint64_t point_bytes() const;  ///< of one point in a binary file; compressed data leaves the
                                      ///< padding fields "_" out
  std::uint64_t point_values() const;  ///< numbers on a line of an ascii file
};

/// Leaves `in` at the line "DATA". Throws std::runtime_error with the line that is wrong, and where
/// the lines contradict each other. The counts are not yet compared with the size of the file.
PcdHeader read_pcd_header(TextScanner& in);

}  // namespace posevote::formats
