// SPDX-License-Identifier: BSD-3-Clause
// A JSON list in a file that is valid JSON after every item: batches run for hours and get killed.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace posevote::formats {

/// Writes `head`, items, each on a line of its own, and a tail. Every append overwrites the old
/// tail with the item and a new tail. A write that fails (full disk) throws std::runtime_error
/// naming the file, which then holds what it held before.
class AppendJson {
 public:
  /// Starts the file anew.
  AppendJson(std::filesystem::path file, const std::string& head, std::string tail);
  /// Goes on with a file that another AppendJson has left with that tail.
  AppendJson(std::filesystem::path file, std::string tail);

  void append(const std::string& item, const std::string& tail);
  void append(const std::string& item) { append(item, tail_); }

 private:
  void put(const std::string& text);

  std::filesystem::path file_;
  std::fstream stream_;
  std::string tail_;
  std::streamoff end_ = 0;  ///< where the tail begins
  bool empty_ = true;
};

}  // namespace posevote::formats
