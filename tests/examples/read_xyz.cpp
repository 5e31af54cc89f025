// SPDX-License-Identifier: BSD-3-Clause
// Example of a format: a point a line, `x y z`, what follows them and lines that begin with # are
// passed over. Copied to nodes/formats/read_xyz.cpp, namespace posevote::formats, scans and models
// may be .xyz files; nothing else names the format.
#include <array>
#include <charconv>
#include <stdexcept>
#include <string>

#include "nodes/formats/format.hpp"

namespace posevote::examples {
namespace {

using formats::RawMesh;

formats::Triple read_point(std::string_view line, std::size_t number) {
  formats::Triple point{};
  for (double& value : point) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc())
      throw std::runtime_error("line " + std::to_string(number) + ": expected x y z");
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
  return point;
}

RawMesh read_xyz(std::string_view bytes) {
  RawMesh mesh;
  for (std::size_t number = 1; !bytes.empty(); ++number) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    mesh.points.push_back(read_point(line, number));
  }
  return mesh;
}

const auto registered = formats::register_format("XYZ", {".xyz"}, read_xyz);

}  // namespace
}  // namespace posevote::examples
