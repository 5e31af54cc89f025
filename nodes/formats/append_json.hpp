// SPDX-License-Identifier: BSD-3-Clause
// A JSON list in a file that is valid JSON after every item: batches run for hours and get killed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace posevote::formats {

/// The text of such a file: `head`, which ends with "[", items, each on a line of its own, and a
/// tail.
std::string json_list(const std::string& head, const std::vector<std::string>& items,
                      const std::string& tail);

/// Every append overwrites the old tail with the item and a new tail, and closes the file, for there
/// are file systems that say only then whether they have room. A write that fails (full disk) throws
/// std::runtime_error naming the file, which then holds what it held before.
class AppendJson {
 public:
  /// Goes on with a file that is there and ends with that tail.
  AppendJson(std::filesystem::path file, std::string tail);

  void append(const std::string& item, const std::string& tail);
  void append(const std::string& item) { append(item, tail_); }

 private:
  std::filesystem::path file_;
  std::string tail_;
  std::uint64_t end_ = 0;  ///< where the tail begins
  bool empty_ = true;
};

}  // namespace posevote::formats
