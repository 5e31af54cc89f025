// SPDX-License-Identifier: BSD-3-Clause
// The parameters of the kernel density, whatever searches for the votes around.
#pragma once

#include <numbers>
#include <stdexcept>

#include "graph/registry.hpp"
#include "nodes/data/votes.hpp"
#include "nodes/density/kernel.hpp"

namespace posevote::density {

struct DensityParams {
  double sigma_t = 0;
  double fraction = 0.06;
  double sigma_r = 22.5;

  /// Throws std::runtime_error where it is to be derived for votes of no model.
  Bandwidth bandwidth_of(const VoteSet& votes) const {
    if (sigma_t == 0 && !votes.model)
      throw std::runtime_error("votes of no model have no bandwidth unless sigma_t says it");
    const double translation =
        sigma_t > 0 ? sigma_t : fraction * static_cast<double>(votes.model->diagonal);
    return {static_cast<float>(translation), static_cast<float>(sigma_r * std::numbers::pi / 180)};
  }
};

/// Registers them.
template <class Registration>
Registration with_density_params(Registration node) {
  node.param("sigma_t", &DensityParams::sigma_t, "m",
             "Bandwidth in translation; votes farther apart do not count. 0 derives it.",
             graph::in_range(0, 10));
  node.param("fraction", &DensityParams::fraction, "x diagonal",
             "Derived bandwidth in translation, as a share of the object's bounding-box diagonal.",
             graph::in_range(0.001, 1));
  node.param("sigma_r", &DensityParams::sigma_r, "deg",
             "Bandwidth in rotation; votes turned farther do not count.", graph::in_range(1, 90));
  return node;
}

}  // namespace posevote::density
