// SPDX-License-Identifier: BSD-3-Clause
// A whole file in memory. Read, not mapped: a mapped file that somebody shortens kills the process.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace posevote::formats {

struct FileBytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;

  std::string_view view() const { return {data.get(), size}; }
};

/// Throws std::runtime_error where there is no such file, where it is a directory, a dangling link,
/// a device, empty, unreadable or larger than 4 GiB (so that 32 bits count everything in it). The
/// text says which, and does not repeat the path.
FileBytes read_file(const std::filesystem::path& path);

/// For messages: printable, in quotes, cut after some characters.
std::string in_quotes(std::string_view text);

/// A T from unaligned bytes of the given byte order.
template <class T>
T load_bytes(const char* bytes, std::endian order = std::endian::little) {
  char copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(copy, copy + sizeof(T));
  return std::bit_cast<T>(copy);
}

/// Whether what follows the data is mere padding: blanks, line ends, zeros.
bool is_padding(std::string_view rest);

}  // namespace posevote::formats
