// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/reader.hpp"

#include <sstream>
#include <stdexcept>

namespace posevote::test {
namespace {

/// A message has lines of bounded length, whatever the file holds.
void require_message(const std::string& text) {
  constexpr std::size_t kLeast = 6, kMost = 1000;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > kMost)
      throw std::logic_error("a message without end: " + line.substr(0, kMost));
  }
  if (text.size() < kLeast) throw std::logic_error("a message that says nothing: " + text);
}

std::vector<Reader> make_readers() {
  std::vector<Reader> all = geometry_readers();
  for (const auto& family : {folder_readers(), config_readers()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all = make_readers();
  return all;
}

bool takes(const Reader& reader, std::string_view bytes) {
  try {
    reader.read(bytes);
    return true;
  } catch (const std::runtime_error& error) {
    require_message(error.what());
  } catch (const std::invalid_argument& error) {
    require_message(error.what());
  }
  return false;
}

}  // namespace posevote::test
