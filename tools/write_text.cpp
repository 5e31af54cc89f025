// SPDX-License-Identifier: BSD-3-Clause
#include "tools/write_text.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace posevote {

void write_text(const std::filesystem::path& file, const std::string& text) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace posevote
