// SPDX-License-Identifier: BSD-3-Clause
// The scales at which a scan is prepared: those at which its objects were described, of each object
// the finest that the sensor can tell, and the next coarser one. What a sensor tells is measured
// from the scan itself, where its surface is near: the points' spacing (geometry/sensor_noise.hpp)
// and how far noise tilts the normals (geometry/normal_noise.hpp). An object whose octaves are all
// finer than that is looked for at its third and the one before: what is coarser than an eightieth
// of an object hardly tells it, whatever the noise. Only where points are farther apart than that,
// coarser ones serve: those of which the last is not finer than the spacing. A library with no more
// octaves than are looked for leaves no choice, and nothing is measured.
//
//   scan_octaves: {in: [scan, library], out: [scale, octaves], radii: 2}
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"
#include "nodes/descriptors/octaves.hpp"
#include "nodes/geometry/normal_noise.hpp"
#include "nodes/geometry/rows_that.hpp"
#include "nodes/geometry/sensor_noise.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  double finest = 0;
  double spacings = 0.6;
  double tilt = 3;
  double apart = 1;
  double near = 0.25;
  int noisy = 3;
  int radii = 2;
};

/// What the sensor resolves, by its noise and its points' spacing, and that spacing [m]; 0 where
/// nothing was measured.
struct Resolved {
  double finest = 0, spacing = 0;
};

constexpr float kWidth = 6;  // x resolution: what a normal sees (estimate_normals.radius: 3)
constexpr double kDegree = 0.017453292519943295;  // [rad]

/// The points no farther from the sensor than that.
std::vector<std::uint32_t> near_rows(const Scan& scan, float range) {
  return geometry::rows_that(static_cast<std::size_t>(scan.points.rows()), [&](std::uint32_t i) {
    return (scan.points.row(i).transpose() - scan.view.origin).norm() <= range;
  });
}

/// Says what is too coarse or too noisy for the objects, whose coarsest octave that is [m].
void warn_of(const graph::FrameContext& context, double spacing, double tilt, double coarsest,
             const Params& params) {
  constexpr double kHopeless = 4;  // x tilt
  char text[160] = "";
  if (params.spacings * spacing > coarsest)
    std::snprintf(text, sizeof text,
                  "the scan's points are %.2g mm apart, too far to tell objects that are described "
                  "at %.2g mm",
                  1000 * spacing, 1000 * coarsest);
  else if (tilt > kHopeless * params.tilt * kDegree)
    std::snprintf(text, sizeof text,
                  "noise tilts the scan's normals by %.0f deg over %.2g mm, too much to tell "
                  "objects of this size",
                  tilt / kDegree, 1000 * coarsest * static_cast<double>(kWidth));
  if (text[0] != '\0') context.warn(text);
}

/// More than the coarsest octave where the sensor does not tell sooner. `octaves`: those of the
/// objects, ascending.
Resolved measure_resolution(const Scan& scan, const std::vector<LibraryOctave>& octaves,
                            const graph::FrameContext& context, const Params& params) {
  if (params.finest > 0) return {params.finest};
  const geometry::SensorNoise noise = geometry::measure_noise(scan.points, scan.view.origin);
  if (noise.ranges.empty()) return {};
  const float range = noise.ranges[static_cast<std::size_t>(
      params.near * static_cast<double>(noise.ranges.size() - 1))];
  const std::vector<std::uint32_t> rows = near_rows(scan, range);
  const auto spacing = static_cast<double>(noise.spacing_at(range));
  const auto coarsest = static_cast<double>(octaves.back().resolution);
  constexpr double kFiner = 0.125;  // of an octave, tells nothing of it
  // From the spacing up, not from the coarsest down: curvature tilts the normals of wide patches.
  double resolution =
      std::max(params.spacings * spacing, kFiner * static_cast<double>(octaves.front().resolution));
  double tilt = 0;
  std::array<std::optional<geometry::NoiseCubes>, 2> cubes;  // every other step is twice as wide
  for (std::size_t step = 0; resolution < coarsest; ++step, resolution *= std::numbers::sqrt2) {
    std::optional<geometry::NoiseCubes>& now = cubes[step % 2];
    if (now)
      now->widen();
    else
      now.emplace(scan.points, rows, kWidth * static_cast<float>(resolution));
    const std::optional<float> found = now->tilt(scan.view.origin);
    if (found) tilt = static_cast<double>(*found);
    if (found && tilt <= params.tilt * kDegree) break;
  }
  context.tell("range_m", {static_cast<double>(range)});
  context.tell("spacing_m", {spacing});
  context.tell("noise_m", {static_cast<double>(noise.noise_at(range))});
  context.tell("normal_tilt_deg", {tilt / kDegree});
  context.tell("resolution_m", {resolution});
  if (resolution >= coarsest) warn_of(context, spacing, tilt, coarsest, params);
  return {resolution, spacing};
}

/// The scales at which an object is looked for: from the finest that is not too fine on.
void add_scales_of(const Model& model, const Resolved& resolved, const Params& params,
                   std::set<float>& scales) {
  const auto octaves = octaves_of(model.features);
  const auto most = static_cast<std::size_t>(params.radii);
  const auto resolution = [&](std::size_t i) { return static_cast<double>(octaves[i].resolution); };
  const std::size_t noisy = params.finest > 0
                                ? octaves.size()
                                : std::min(octaves.size(), static_cast<std::size_t>(params.noisy));
  std::size_t first = 0;
  while (first + most < noisy && resolution(first) < resolved.finest) ++first;
  const double apart = params.apart * resolved.spacing;
  while (first + most < octaves.size() && resolution(first + most - 1) < apart) ++first;
  for (std::size_t i = first; i < std::min(octaves.size(), first + most); ++i)
    scales.insert(octaves[i].resolution);
}

std::tuple<Scale, PerObject<Scale>> scan_octaves(const Scan& scan, const ModelLibrary& library,
                                                 const graph::FrameContext& context,
                                                 const Params& params) {
  if (library.octaves.empty()) throw std::runtime_error("the model library has no index");
  const bool has_choice = library.octaves.size() > static_cast<std::size_t>(params.radii);
  const Resolved resolved =
      has_choice ? measure_resolution(scan, library.octaves, context, params) : Resolved{};
  std::set<float> scales;
  for (const auto& model : library.models) add_scales_of(*model, resolved, params, scales);
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
        .param("tilt", &Params::tilt, "deg",
               "And so coarse that noise tilts its normals by no more than this, a standard "
               "deviation.",
               graph::in_range(0, 90))
        .param(
            "apart", &Params::apart, "x spacing",
            "The coarsest octave at which an object is looked for is at least this, if it has one "
            "that is.",
            graph::at_least(0))
        .param("noisy", &Params::noisy, "",
               "Of so many of an object's octaves, the finest, noise chooses; coarser ones are for "
               "scans whose points are farther apart than these.",
               graph::in_range(1, 12))
        .param("radii", &Params::radii, "",
               "Octaves at which each object is looked for, at most: descriptors of so many radii.",
               graph::in_range(1, 8))
        .param("near", &Params::near, "",
               "Both at the range before which this share of the scan's surface lies.",
               graph::in_range(0, 1));

}  // namespace
}  // namespace posevote::prepare
