// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/file_bytes.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace posevote::formats {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 32;

std::uintmax_t checked_size(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    std::error_code no_link;
    const fs::path target = fs::read_symlink(path, no_link);
    throw std::runtime_error(no_link ? "there is no such file"
                                     : "dangling link: its target " + target.string() +
                                           " does not exist");
  }
  if (status.type() == fs::file_type::none) throw std::runtime_error(error.message());
  if (fs::is_directory(status)) throw std::runtime_error("is a directory, expected a file");
  if (!fs::is_regular_file(status)) throw std::runtime_error("is not a regular file");
  const std::uintmax_t size = fs::file_size(path);
  if (size == 0) throw std::runtime_error("the file is empty (0 bytes)");
  if (size > kMaxBytes)
    throw std::runtime_error("the file has " + std::to_string(size) + " bytes, expected at most " +
                             std::to_string(kMaxBytes));
  return size;
}

}  // namespace

FileBytes read_file(const std::filesystem::path& path) {
  FileBytes bytes;
  bytes.size = static_cast<std::size_t>(checked_size(path));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file)
    throw std::runtime_error("cannot be opened: " + std::generic_category().message(errno));
  bytes.data.reset(new char[bytes.size]);  // not make_unique: it would write every byte first
  const std::size_t got = std::fread(bytes.data.get(), 1, bytes.size, file.get());
  if (got != bytes.size)
    throw std::runtime_error("only " + std::to_string(got) + " of " + std::to_string(bytes.size) +
                             " bytes could be read");
  return bytes;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 24;
  std::string out = "'";
  for (const char c : text.substr(0, kShown)) {
    if (c >= ' ' && c <= '~') {
      out += c;
    } else {
      char hex[8];
      std::snprintf(hex, sizeof hex, "\\x%02x", static_cast<unsigned>(c) & 0xffU);
      out += hex;
    }
  }
  return out + (text.size() > kShown ? "...'" : "'");
}

bool is_padding(std::string_view rest) {
  constexpr std::string_view kPadding(" \t\r\n\0", 5);
  return rest.find_first_not_of(kPadding) == std::string_view::npos;
}

}  // namespace posevote::formats
