// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/material_library.hpp"

#include <algorithm>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/text_scanner.hpp"

namespace posevote::formats {
namespace {

/// What follows the keyword: a name, which may hold blanks. Options before it ("-s 1 1 1") have
/// arguments whose number only a full reader knows; then the last word is the file.
std::string image_name(TextScanner& in) {
  std::string name = in.rest_of_line();
  if (name.starts_with('-')) name.erase(0, name.find_last_of(" \t") + 1);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace

std::map<std::string, Material> read_materials(const std::filesystem::path& file) {
  const FileBytes bytes = read_file(file);
  TextScanner in(bytes.view(), '#');
  std::map<std::string, Material> materials;
  Material* current = nullptr;
  while (in.next_line()) {
    const std::string_view keyword = in.word();
    if (keyword == "newmtl") {
      current = &materials[in.rest_of_line()];
    } else if (keyword == "Kd" || keyword == "map_Kd") {
      if (!current) in.fail("a colour before the first material");
      if (keyword == "map_Kd")
        current->image = image_name(in);
      else
        for (double& value : current->color) value = in.number();
    }
  }
  return materials;
}

}  // namespace posevote::formats
