// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/camera_file.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/text_scanner.hpp"
#include "nodes/layouts/files.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Of a 3 x 3 matrix, row by row.
Camera of_matrix(const std::vector<double>& k) { return {k[0], k[4], k[2], k[5], 0}; }

Camera of_json(const json& root) {
  Camera camera;
  if (root.contains("cam_K")) {
    camera = of_matrix(numbers(root["cam_K"], 9, "cam_K"));
  } else if (root.contains("intrinsic_matrix")) {
    const std::vector<double> k = numbers(root["intrinsic_matrix"], 9, "intrinsic_matrix");
    camera = {k[0], k[4], k[6], k[7], 0};
  } else {
    camera = {root.at("fx").get<double>(), root.at("fy").get<double>(), root.at("cx").get<double>(),
              root.at("cy").get<double>(), 0};
  }
  camera.depth_scale = root.value("depth_scale", 0.0);
  if (root.contains("depth_scale") && !(camera.depth_scale > 0))
    throw std::invalid_argument("depth_scale must be > 0 (mm per unit)");
  return camera;
}

Camera of_text(const fs::path& file) {
  const formats::FileBytes bytes = formats::read_file(file);
  formats::TextScanner in(bytes.view(), '#');
  std::vector<double> values;
  while (in.next_line())
    while (!in.line_done()) values.push_back(in.number());
  if (values.size() == 4) return {values[0], values[1], values[2], values[3], 0};
  if (values.size() == 9) return of_matrix(values);
  throw std::invalid_argument("has " + std::to_string(values.size()) +
                              " numbers, expected fx fy cx cy or a 3 x 3 matrix");
}

Camera read_camera(const fs::path& file) {
  return located(file, "camera", [&] {
    const Camera camera = file.extension() == ".json" ? of_json(read_json(file)) : of_text(file);
    if (!(camera.fx > 0) || !(camera.fy > 0))
      throw std::invalid_argument("fx and fy must be > 0 (pixels)");
    return camera;
  });
}

}  // namespace

std::optional<Camera> find_camera(const fs::path& folder) {
  for (const char* name : {"camera.json", "camera_intrinsic.json", "intrinsics.json",
                           "intrinsics.txt", "camera-intrinsics.txt"})
    if (fs::exists(folder / name)) return read_camera(folder / name);
  return std::nullopt;
}

std::optional<Camera> camera_beside(const fs::path& image) {
  const std::optional<Camera> camera = find_camera(image.parent_path());
  return camera ? camera : find_camera(image.parent_path().parent_path());
}

}  // namespace posevote::layouts
