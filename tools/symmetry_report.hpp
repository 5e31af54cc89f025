// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "nodes/data/model.hpp"

namespace posevote {

/// "a turn of 180 deg about (0 0 1)"
std::string turn_text(const Eigen::Matrix3d& rotation);

/// The motions that carry a model onto itself, exactly or nearly, a line each; for `train --report`.
std::string symmetry_report(const Model& model);

/// The same: rotations as 9 numbers row by row, directions and points in the model's frame, lengths
/// in m; of near symmetries the share of the surface that tells.
nlohmann::ordered_json symmetry_json(const Model& model);

}  // namespace posevote
