// SPDX-License-Identifier: BSD-3-Clause
// What is in a user's files, before anything is run. Lengths are in the files' own units.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"

namespace posevote::init {

struct ModelLook {
  std::filesystem::path file;
  std::string name;
  std::string unreadable;  ///< why; the rest says nothing then
  std::size_t points = 0, faces = 0;
  Eigen::Vector3d sides = Eigen::Vector3d::Zero();  ///< of the bounding box
  double diagonal = 0;
  std::size_t parts = 0, open_edges = 0;  ///< of its faces; edges of one face alone
  double turned = 0;              ///< share of the surface's points whose faces are wound inward
  std::optional<double> outward;  ///< share of the file's normals that point outward, if it has any
};

struct ScanLook {
  std::filesystem::path file;
  std::string unreadable;
  bool is_depth = false;
  std::size_t width = 0, height = 0;  ///< of a depth image or an organised point file; else 0
  std::size_t points = 0;
  Eigen::Vector3d sides = Eigen::Vector3d::Zero();  ///< without strays
  double diagonal = 0;
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
  bool says_sensor = false;      ///< the file does, or one beside it
  std::optional<double> facing;  ///< share of its normals that point to the sensor, if it has any
  bool lies_before = true;       ///< the scan, its sensor, as far as that is said
  double range = 0, spacing = 0, noise = 0;  ///< medians
};

ModelLook look_at_model(const ModelFile& model);

/// A depth image is looked at by `camera`, its depths as if a unit were 1 mm.
ScanLook look_at_scan(const SceneFile& scan, const std::optional<Camera>& camera);

/// A scan as load_scene loads it with these overrides ("param=value" of it), and what it warned of.
/// Throws what the node throws.
struct LoadedScan {
  Scan scan;
  std::vector<std::string> warnings;
};
LoadedScan load_scan(const SceneFile& scan, const std::vector<std::string>& sets);

}  // namespace posevote::init
