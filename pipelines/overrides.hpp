// SPDX-License-Identifier: BSD-3-Clause
// Options that stand for a parameter of a node: they set it over the config and --set, and what is
// wrong with the value is laid to the option.
#pragma once

#include <string>
#include <vector>

#include "graph/description.hpp"

namespace posevote {

/// --model-unit, unless empty.
std::vector<graph::Override> model_overrides(const std::string& model_unit);

/// --scene-unit and --sensor-pose, unless empty. The latter is a text of numbers, or the name of a
/// file that holds it. Throws std::invalid_argument naming the option, the file and the cause.
std::vector<graph::Override> scene_overrides(const std::string& scene_unit,
                                             const std::string& sensor_pose);

}  // namespace posevote
