// SPDX-License-Identifier: BSD-3-Clause
// Writes a data set in BOP layout (bop.felk.cvut.cz): models, depth images, ground truth; beside it
// the same scans as PLY.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "nodes/data/cloud.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote {

class BopWriter {
 public:
  /// Makes the folder. Targets leave out instances less visible than `least_visible`. Throws
  /// std::runtime_error where the folder cannot be made.
  BopWriter(std::filesystem::path out, double least_visible);

  void add_model(int obj_id, const Mesh& mesh, const ShapeSymmetry& symmetry,
                 const Paint* paint = nullptr);
  /// The next image (0, 1 ...) of scene 1. Bodies with an obj_id of 0 are not part of the truth.
  void add_image(const std::vector<Body>& bodies, const Sensor& sensor,
                 const Eigen::Isometry3d& T_world_sensor, const SimulatedScan& scan);
  /// Writes the lists of all models and images.
  void finish() const;
  /// Whether a writer makes a file or folder of this name in the set's folder.
  static bool makes(const std::filesystem::path& name);

 private:
  std::filesystem::path out_;
  double least_visible_;
  int images_ = 0;
  nlohmann::ordered_json models_info_, cameras_, gt_, gt_info_;
  nlohmann::ordered_json targets_ = nlohmann::ordered_json::array();
};

}  // namespace posevote
