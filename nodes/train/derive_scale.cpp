// SPDX-License-Identifier: BSD-3-Clause
// The resolutions at which each model is sampled and described: its octaves, each twice the one
// before. Everything else (normal and descriptor radii, feature spacing, ICP distances) is a
// multiple of them, so a descriptor sees some fifteen hundredths of the object at the finest and
// half of it at the coarsest: local ones hold in clutter, wide ones tell flat and large objects.
//
// An object's octaves follow from its own bounding box, rounded to a power of two times `grid`, so
// that objects share them: descriptors agree only where models and scans are sampled alike, and a
// scan is prepared once for each octave, not for each object.
//
// Slot k n + i of both outputs is octave k of model i of n; the meshes are the same for all k.
//
//   derive_scale: {in: model_meshes, out: [octave_meshes, octaves], fraction: 0.006, octaves: 3}
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"
#include "nodes/geometry/extent.hpp"

namespace posevote::train {
namespace {

struct Params {
  double resolution = 0;
  double fraction = 0.006;
  double finest = 0;
  double grid = 0.00125;
  int octaves = 3;
};

/// The finest octave of a model [m].
double finest_octave(const Mesh& mesh, const Params& params) {
  if (params.resolution > 0) return params.resolution;
  const double own = params.fraction * geometry::model_diagonal(mesh.points);
  return params.grid * std::exp2(std::round(std::log2(own / params.grid)));
}

std::tuple<PerObject<Mesh>, PerObject<Scale>> derive_scale(const PerObject<Mesh>& meshes,
                                                           const Params& params) {
  if (meshes.slots.empty()) throw std::runtime_error("there are no models to derive a scale from");
  std::vector<double> resolutions;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    try {
      resolutions.push_back(finest_octave(meshes[i], params));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("model " + std::to_string(i + 1) + " of " +
                               std::to_string(meshes.size()) + " " + error.what());
    }
    while (params.finest > 0 && resolutions.back() < params.finest) resolutions.back() *= 2;
  }
  PerObject<Mesh> all;
  PerObject<Scale> scales;
  for (int k = 0; k < (params.resolution > 0 ? 1 : params.octaves); ++k)
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      all.slots.push_back(meshes.slots[i]);
      scales.slots.push_back(
          std::make_shared<const Scale>(Scale{static_cast<float>(std::ldexp(resolutions[i], k))}));
    }
  return {std::move(all), std::move(scales)};
}

const auto registered =
    graph::register_node("derive_scale", derive_scale,
                         "The resolutions at which each model is sampled: its octaves.")
        .input("meshes")
        .output("octave_meshes")
        .output("octaves")
        .param("resolution", &Params::resolution, "m",
               "Voxel edge, by hand, of all models and of the scans: one octave; 0 derives them.",
               graph::at_least(0))
        .param("fraction", &Params::fraction, "x diagonal",
               "About the finest octave, as a share of the model's bounding-box diagonal.",
               graph::in_range(0.0005, 0.1))
        .param("finest", &Params::finest, "m", "No octave is finer than this; 0: no limit.",
               graph::at_least(0))
        .param("grid", &Params::grid, "m", "Octaves are this times a power of two.",
               graph::greater_than(0))
        .param("octaves", &Params::octaves, "", "How many of them.", graph::in_range(1, 8));

}  // namespace
}  // namespace posevote::train
