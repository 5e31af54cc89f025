// SPDX-License-Identifier: BSD-3-Clause
// What files and records hold, as a number that tells it from anything else: XXH3-128, written as 32
// hexadecimal digits. It guards against accidents, not against forgers.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace posevote::library {

std::string checksum(std::string_view bytes);

/// The same of bytes that come piece by piece.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(std::string_view bytes);
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Over the files' lengths and bytes, in this order, and the text. Throws std::runtime_error naming a
/// file that cannot be read.
std::string hash_files(const std::vector<std::filesystem::path>& files, const std::string& text);

}  // namespace posevote::library
