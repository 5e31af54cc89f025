// SPDX-License-Identifier: BSD-3-Clause
// Every reader of files behind one function: bytes go in, and are taken or refused. What the tests of
// damage and the fuzzers (README.md in this folder) share.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace posevote::test {

/// A small valid file.
struct Sample {
  std::string name;
  std::string bytes;
  /// Whether a file that ends before its last line is no valid one.
  bool ends_known = true;
};

struct Reader {
  std::string name;  ///< for the command line: "ply"
  /// Takes a file's bytes, or throws std::runtime_error or std::invalid_argument that says what is
  /// wrong. Everything else that it throws is a fault, as is a result that is not valid.
  std::function<void(std::string_view)> read;
  std::vector<Sample> samples;
};

/// All of them; those of one family are made by one of the functions below.
const std::vector<Reader>& readers();

std::vector<Reader> geometry_readers();  ///< meshes, scans, depth images
std::vector<Reader> folder_readers();    ///< data sets and recordings: cameras, poses, lists
std::vector<Reader> config_readers();    ///< YAML, libraries, results

/// True if the reader took the bytes, false if it refused them. Throws std::logic_error where the
/// message tells nothing, or does not end.
bool takes(const Reader& reader, std::string_view bytes);

}  // namespace posevote::test
