// SPDX-License-Identifier: BSD-3-Clause
// The resolutions at which each model is sampled and described: its octaves, each a half octave
// (`step`) above the one before. Everything else (normal and descriptor radii, feature spacing, ICP
// distances) is a multiple of them. Descriptors agree only where models and scans are sampled
// alike, so a scan is prepared at those octaves that its sensor can tell (prepare/scan_octaves.cpp),
// once for all objects that share them.
//
// By default all objects have the same, which follow from their mean size. Measured over sensors and
// objects, the first and the second are what suits: finer costs time and tells no more, and coarser
// loses small objects. The third is there for its wider descriptors, whose votes count together with
// those of the next finer: local ones hold in clutter, wide ones tell flat and large objects. The
// fourth is for scans whose points are farther apart than that. With `own`, an object's finest
// follows from its own bounding box, rounded to a grid of half octaves, so that objects of like size
// share it.
//
// Slot k n + i of both outputs is octave k of model i of n; the meshes are the same for all k.
//
//   derive_scale: {in: model_meshes, out: [octave_meshes, octaves], fraction: 0.0085, octaves: 4}
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
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
  double fraction = 0.0085;
  double finest = 0;
  bool own = false;
  int octaves = 4;
  double step = std::numbers::sqrt2;
};

constexpr double kGrid = 0.00125;  // [m]; of own resolutions: this times half powers of two

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double round_to_grid(double resolution) {
  return kGrid * std::exp2(std::round(2 * std::log2(resolution / kGrid)) / 2);
}

std::vector<double> diagonals_of(const PerObject<Mesh>& meshes) {
  std::vector<double> diagonals;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    try {
      diagonals.push_back(geometry::model_diagonal(meshes[i].points));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("model " + std::to_string(i + 1) + " of " +
                               std::to_string(meshes.size()) + " " + error.what());
    }
  }
  return diagonals;
}

/// The finest octave of each model [m].
std::vector<double> finest_octaves(const PerObject<Mesh>& meshes, const Params& params) {
  if (params.resolution > 0) return std::vector<double>(meshes.size(), params.resolution);
  std::vector<double> octaves = diagonals_of(meshes);
  const double mean = mean_of(octaves);
  for (double& octave : octaves) {
    octave = params.fraction * (params.own ? octave : mean);
    octave = std::max(params.finest, params.own ? round_to_grid(octave) : octave);
  }
  return octaves;
}

std::tuple<PerObject<Mesh>, PerObject<Scale>> derive_scale(const PerObject<Mesh>& meshes,
                                                           const Params& params) {
  if (meshes.slots.empty()) throw std::runtime_error("there are no models to derive a scale from");
  const std::vector<double> finest = finest_octaves(meshes, params);
  PerObject<Mesh> all;
  PerObject<Scale> scales;
  for (int k = 0; k < params.octaves; ++k)
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const auto resolution = static_cast<float>(finest[i] * std::pow(params.step, k));
      all.slots.push_back(meshes.slots[i]);
      scales.slots.push_back(std::make_shared<const Scale>(Scale{resolution}));
    }
  return {std::move(all), std::move(scales)};
}

const auto registered =
    graph::register_node("derive_scale", derive_scale,
                         "The resolutions at which each model is sampled: its octaves.")
        .input("meshes")
        .output("octave_meshes")
        .output("octaves")
        .param("resolution", &Params::resolution, "m", "Voxel edge of the finest; 0 derives it.",
               graph::at_least(0))
        .param("fraction", &Params::fraction, "x diagonal",
               "Derived finest resolution, as a share of the bounding-box diagonal: of the models' "
               "mean, or of their own.",
               graph::in_range(0.0005, 0.1))
        .param("finest", &Params::finest, "m", "Derived resolutions are never finer than this.",
               graph::at_least(0))
        .param("own", &Params::own, "",
               "Whether each model's resolution follows from its own size.")
        .param("octaves", &Params::octaves, "",
               "Resolutions of each model, each `step` times the one before.",
               graph::in_range(1, 12))
        .param("step", &Params::step, "x", "Of an octave over the one before.",
               graph::in_range(1.1, 4));

}  // namespace
}  // namespace posevote::train
