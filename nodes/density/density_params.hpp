// SPDX-License-Identifier: BSD-3-Clause
// The parameters of the kernel density, whatever searches for the votes around.
#pragma once

#include <numbers>

#include "graph/registry.hpp"
#include "nodes/density/kernel.hpp"

namespace posevote::density {

struct DensityParams {
  double sigma_t = 0.01;
  double sigma_r = 22.5;

  Bandwidth bandwidth() const {
    return {static_cast<float>(sigma_t), static_cast<float>(sigma_r * std::numbers::pi / 180)};
  }
};

/// Registers them.
template <class Registration>
Registration with_density_params(Registration node) {
  node.param("sigma_t", &DensityParams::sigma_t, "m",
             "Bandwidth in translation; votes farther apart do not count.",
             graph::in_range(1e-5, 10));
  node.param("sigma_r", &DensityParams::sigma_r, "deg",
             "Bandwidth in rotation; votes turned farther do not count.", graph::in_range(1, 90));
  return node;
}

}  // namespace posevote::density
