// SPDX-License-Identifier: BSD-3-Clause
// The scales at which a scan is prepared: those at which its objects were described, of each object
// the finest that the sensor can tell. Noise and point spacing are measured from the scan itself
// (sensor_noise.hpp) and taken at the range of its nearer parts: a depth camera sees its background
// farther away and more coarsely than what stands before it. Where all octaves of an object are too
// fine its coarsest is taken. Where the library has but one scale, that is the scan's.
//
//   scan_octaves: {in: [scan, library], out: [scale, octaves], radii: 2}
#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>
#include <tuple>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"
#include "nodes/geometry/sensor_noise.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  double finest = 0;
  double spacings = 1.25;
  double noises = 1.25;
  double near = 0.1;
  int radii = 2;
};

/// What the sensor resolves [m].
double finest_resolution(const Scan& scan, const Params& params) {
  if (params.finest > 0) return params.finest;
  const geometry::SensorNoise noise = geometry::measure_noise(scan.points, scan.view.origin);
  if (noise.ranges.empty()) return 0;
  const float range = noise.ranges[static_cast<std::size_t>(
      params.near * static_cast<double>(noise.ranges.size() - 1))];
  return std::max(params.noises * static_cast<double>(noise.noise_at(range)),
                  params.spacings * static_cast<double>(noise.spacing_at(range)));
}

/// The scales at which an object is looked for: its finest that are not too fine, or its coarsest.
void add_scales_of(const Model& model, double finest, int most, std::set<float>& scales) {
  int count = 0;
  for (const Octave& octave : octaves_of(model.features))
    if (octave.resolution >= finest && count++ < most) scales.insert(octave.resolution);
  if (count == 0) scales.insert(octaves_of(model.features).back().resolution);
}

std::tuple<Scale, PerObject<Scale>> scan_octaves(const Scan& scan, const ModelLibrary& library,
                                                 const Params& params) {
  if (library.octaves.empty()) throw std::runtime_error("the model library has no index");
  const bool has_choice = library.octaves.size() > 1;
  const double finest =
      has_choice ? 0.99 * finest_resolution(scan, params) : 0;  // float against double
  std::set<float> scales;
  for (const auto& model : library.models) add_scales_of(*model, finest, params.radii, scales);
  PerObject<Scale> octaves;
  for (const float resolution : scales)
    octaves.slots.push_back(std::make_shared<const Scale>(Scale{resolution}));
  const Scale scale = octaves[0];
  return {scale, std::move(octaves)};
}

const auto registered =
    graph::register_node("scan_octaves", scan_octaves,
                         "The scales at which a scan is prepared, and the finest of them.")
        .input("scan")
        .input("library")
        .output("scale")
        .output("octaves")
        .param("finest", &Params::finest, "m",
               "No octave of the scan is finer than this; 0: what its noise and spacing say.",
               graph::at_least(0))
        .param("spacings", &Params::spacings, "x spacing",
               "The finest octave is at least this times the points' spacing.", graph::at_least(0))
        .param("noises", &Params::noises, "x noise",
               "And this times the noise, a standard deviation.", graph::at_least(0))
        .param("radii", &Params::radii, "",
               "Octaves at which each object is looked for, at most: descriptors of so many radii.",
               graph::in_range(1, 8))
        .param("near", &Params::near, "",
               "Both at the range before which this share of the scan's surface lies.",
               graph::in_range(0, 1));

}  // namespace
}  // namespace posevote::prepare
