// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "nodes/data/model.hpp"

namespace posevote {

/// The motions that carry a model onto itself, exactly or nearly, a line each; for `train --report`.
std::string symmetry_report(const Model& model);

}  // namespace posevote
