// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/read_scan.hpp"

#include <algorithm>
#include <stdexcept>
#include <variant>

#include "nodes/color/texture_color.hpp"
#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/paint_mesh.hpp"
#include "nodes/formats/raw_mesh.hpp"
#include "nodes/formats/triangulate.hpp"

namespace posevote::formats {
namespace {

/// The reader of a file's format, which must make what `Read` returns.
template <class Read>
Read find_reader(const std::filesystem::path& path, Wanted wanted) {
  const Format* format = find_format(path);
  if (const Read* read = format ? std::get_if<Read>(&format->read) : nullptr) return *read;
  throw std::runtime_error("has the ending " + in_quotes(path.extension().string()) +
                           ", expected " + list_endings(wanted));
}

/// With a texture where there is one.
Scan read_surface(const std::filesystem::path& path, double metres_per_unit, Seams seams,
                  const Warn& warn) {
  const FileBytes bytes = read_file(path);
  RawMesh mesh = find_reader<ReadMesh>(path, Wanted::kMeshes)(bytes.view());
  try {
    paint_mesh(mesh, path.parent_path(), seams);
  } catch (const std::runtime_error& error) {
    mesh.color_doubt = error.what();
  }
  if (warn && !mesh.color_doubt.empty()) warn("its colours are left out: " + mesh.color_doubt);
  mend_concave(mesh);
  return to_scan(mesh, metres_per_unit);
}

}  // namespace

Scan read_scan(const std::filesystem::path& path, double metres_per_unit, const Warn& warn) {
  Scan scan = read_surface(path, metres_per_unit, Seams::kJoin, warn);
  scan.colors = color::point_colors(scan);
  scan.texture = nullptr;
  return scan;
}

Mesh read_mesh(const std::filesystem::path& path, double metres_per_unit, const Warn& warn) {
  return read_surface(path, metres_per_unit, Seams::kSplit, warn);
}

DepthImage read_depth_image(const std::filesystem::path& path) {
  const ReadDepth read = find_reader<ReadDepth>(path, Wanted::kDepthImages);
  if (const ReadEntry entry = find_format(path)->entry) return read(entry(path));
  return read(read_file(path).view());
}

std::vector<float> depths_of(const DepthImage& image, double millimetres_per_unit) {
  if (!image.metres.empty()) return image.metres;
  std::vector<float> depths(image.values.size());
  std::transform(image.values.begin(), image.values.end(), depths.begin(),
                 [millimetres_per_unit](std::uint16_t raw) {
                   return static_cast<float>(raw * millimetres_per_unit * 0.001);
                 });
  return depths;
}

}  // namespace posevote::formats
