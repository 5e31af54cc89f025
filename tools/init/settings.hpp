// SPDX-License-Identifier: BSD-3-Clause
// What a config for somebody's data says that the defaults do not.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"

namespace posevote::init {

struct Settings {
  std::string model_unit = "m", scene_unit = "m";  ///< of formats::length_units()
  std::optional<Camera> camera;                    ///< of depth images, with their scale
  std::optional<Eigen::Vector3d> sensor;           ///< where it stood, in the unit of point files

  /// As `--set` takes them.
  std::vector<std::string> sets() const;
};

/// A number for a config: all digits that it takes, no more.
std::string number(double value);

}  // namespace posevote::init
