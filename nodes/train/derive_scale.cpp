// SPDX-License-Identifier: BSD-3-Clause
// Derives the one length unit of a run, the resolution, from the sizes of all models: descriptors
// of models and scans agree only where both are sampled alike. Everything else (normal and
// descriptor radii, feature spacing, ICP distances) is a multiple of it.
//
//   derive_scale: {in: model_meshes, out: scale, fraction: 0.006}
#include <algorithm>
#include <stdexcept>
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/extent.hpp"

namespace posevote::train {
namespace {

struct Params {
  double resolution = 0;
  double fraction = 0.006;
  double finest = 0.0005;
};

Scale derive_scale(const PerObject<Mesh>& meshes, const Params& params) {
  if (params.resolution > 0) return {static_cast<float>(params.resolution)};
  if (meshes.slots.empty()) throw std::runtime_error("there are no models to derive a scale from");
  double sum = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    try {
      sum += geometry::model_diagonal(meshes[i].points);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("model " + std::to_string(i + 1) + " of " +
                               std::to_string(meshes.size()) + " " + error.what());
    }
  }
  const double mean_diagonal = sum / static_cast<double>(meshes.size());
  return {static_cast<float>(std::max(params.finest, params.fraction * mean_diagonal))};
}

const auto registered =
    graph::register_node("derive_scale", derive_scale,
                         "The resolution at which models and scans are sampled.")
        .input("meshes")
        .output("scale")
        .param("resolution", &Params::resolution, "m", "Voxel edge; 0 derives it.",
               graph::at_least(0))
        .param("fraction", &Params::fraction, "x mean diagonal",
               "Derived resolution, as a share of the models' mean bounding-box diagonal.",
               graph::in_range(0.0005, 0.1))
        .param("finest", &Params::finest, "m", "Derived resolution is never finer than this.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote::train
