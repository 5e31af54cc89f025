// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/paint_files.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/material_library.hpp"
#include "nodes/formats/ply_header.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;

/// Those of lines that are commented out, too: nobody is harmed.
std::vector<std::string> libraries_of_obj(std::string_view bytes) {
  constexpr std::string_view kKeyword = "mtllib";
  std::vector<std::string> libraries;
  for (std::size_t at = bytes.find(kKeyword); at != bytes.npos; at = bytes.find(kKeyword, at)) {
    TextScanner line(bytes.substr(at, bytes.find('\n', at) - at), '#');
    at += kKeyword.size();
    if (line.next_line() && line.word() == kKeyword) libraries.push_back(line.rest_of_line());
  }
  return libraries;
}

/// Of libraries, and the images that they name.
std::vector<std::string> paint_of_obj(const fs::path& folder, std::string_view bytes) {
  std::vector<std::string> names = libraries_of_obj(bytes);
  for (const std::string& library : std::vector(names)) try {
      for (const auto& [name, material] : read_materials(folder / library))
        names.push_back(material.image);
    } catch (const std::runtime_error&) {  // it stands in the list, if it is there
    }
  return names;
}

}  // namespace

std::vector<fs::path> paint_files(const fs::path& mesh) {
  const Format* format = find_format(mesh);
  if (!format || (format->name != "OBJ" && format->name != "PLY")) return {};
  std::vector<std::string> names;
  try {
    const FileBytes bytes = read_file(mesh);
    if (format->name == "OBJ") {
      names = paint_of_obj(mesh.parent_path(), bytes.view());
    } else {
      TextScanner header(bytes.view());
      if (header.next_line()) names = read_ply_header(header).images;  // after "ply"
    }
  } catch (const std::runtime_error&) {
  }
  std::vector<fs::path> files;
  std::error_code is_loop;  // of links
  for (const std::string& name : names)
    if (!name.empty() && fs::is_regular_file(mesh.parent_path() / name, is_loop))
      files.push_back(mesh.parent_path() / name);
  return files;
}

}  // namespace posevote::formats
