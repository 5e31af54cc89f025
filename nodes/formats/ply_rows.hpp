// SPDX-License-Identifier: BSD-3-Clause
// The rows of a PLY file's body, as text or binary, behind one interface: begin_row, then value or
// skip for every property, end_row, and end_file at last. All throw std::runtime_error with the
// line or byte, and the row.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/ply_header.hpp"
#include "nodes/formats/text_scanner.hpp"

namespace posevote::formats {

/// "vertex 3 of 100", counted from 1 as a reader of the header would.
inline std::string row_name(const PlyElement& element, std::uint64_t row) {
  return element.name + " " + std::to_string(row + 1) + " of " + std::to_string(element.count);
}

/// One row a line.
class AsciiRows {
 public:
  explicit AsciiRows(const TextScanner& at_body) : in_(at_body) {}

  void begin_row(const PlyElement& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
    if (!in_.next_line())
      throw std::runtime_error("the file ends after line " + std::to_string(in_.line()) +
                               ", expected " + row_name(element, row));
  }
  double value(PlyType) { return in_.number(); }
  void skip(PlyType, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i)
      if (in_.word().empty()) fail("the line ends within a list");
  }
  void end_row() {
    if (!in_.line_done())
      fail("more on the line than the header says, from " + in_quotes(in_.word()));
  }
  void end_file() {
    if (in_.next_line()) in_.fail("more in the file than the header says");
  }
  [[noreturn]] void fail(const std::string& problem) const {
    in_.fail(problem + " (" + row_name(*element_, row_) + ")");
  }

 private:
  TextScanner in_;
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
};

/// One row behind the other.
class BinaryRows {
 public:
  BinaryRows(std::string_view bytes, std::size_t body, std::endian order)
      : bytes_(bytes), at_(body), order_(order) {}

  void begin_row(const PlyElement& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
  }
  double value(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return take<std::int8_t>();
      case PlyType::kUint8:
        return take<std::uint8_t>();
      case PlyType::kInt16:
        return take<std::int16_t>();
      case PlyType::kUint16:
        return take<std::uint16_t>();
      case PlyType::kInt32:
        return take<std::int32_t>();
      case PlyType::kUint32:
        return take<std::uint32_t>();
      case PlyType::kFloat32:
        return static_cast<double>(take<float>());
      default:
        return take<double>();
    }
  }
  void skip(PlyType type, std::uint64_t count) {
    if (count > (bytes_.size() - at_) / size_of(type)) fail_short();
    at_ += count * size_of(type);
  }
  void end_row() {}
  void end_file() {
    if (!is_padding(bytes_.substr(at_)))
      throw std::runtime_error(std::to_string(bytes_.size() - at_) +
                               " bytes more in the file than the header says");
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw std::runtime_error("byte " + std::to_string(at_) + ": " + problem + " (" +
                             row_name(*element_, row_) + ")");
  }

 private:
  template <class T>
  T take() {
    if (bytes_.size() - at_ < sizeof(T)) fail_short();
    const T value = load_bytes<T>(bytes_.data() + at_, order_);
    at_ += sizeof(T);
    return value;
  }
  [[noreturn]] void fail_short() const {
    throw std::runtime_error("the file ends at byte " + std::to_string(bytes_.size()) +
                             ", within " + row_name(*element_, row_));
  }

  std::string_view bytes_;
  std::size_t at_;
  std::endian order_;
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
};

}  // namespace posevote::formats
