// SPDX-License-Identifier: BSD-3-Clause
#include "tools/write_text.hpp"

#include "graph/write_file.hpp"

namespace posevote {

void write_text(const std::filesystem::path& file, const std::string& text) {
  graph::write_file(file, text);
}

}  // namespace posevote
