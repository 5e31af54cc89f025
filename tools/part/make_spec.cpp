// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/part/part.hpp"

namespace posevote::part {
namespace {

/// From in full view to nearly buried.
struct Heap {
  int clutter = 0;     ///< bodies
  bool above = false;  ///< whether all of them lie above the parts, between fences
};
constexpr Heap kHeaps[] = {{0, false}, {5, false}, {5, true}, {10, true}};
constexpr double kRadius = 0.7;  ///< within which all are dropped, x diagonal of the largest part
constexpr int kCopies = 2;       ///< of one part in a scan; of several parts one each
constexpr double kLargestClutter = 0.8;  ///< x diagonal

}  // namespace

Spec make_spec(const Command& command, double range, double diagonal) {
  Spec spec;
  spec.seed = command.seed;
  spec.least_visible = 0.1;
  spec.clutter_size = kLargestClutter * diagonal;
  SceneSpec scene;
  for (const std::string& file : command.models) {
    ModelSpec& model = spec.models.emplace_back();
    model.file = file, model.unit = command.model_unit;
    const int copies = command.models.size() == 1 ? kCopies : 1;
    scene.objects.insert(scene.objects.end(), static_cast<std::size_t>(copies),
                         static_cast<int>(spec.models.size()));
  }
  scene.sensor = command.sensor;
  if (command.noise) scene.noise = *command.noise;
  scene.distance = range;
  // More parts make a wider heap.
  const double spread = std::max(1.0, std::sqrt(static_cast<double>(scene.objects.size()) / 2));
  scene.radius = kRadius * diagonal * spread;
  for (int i = 0; i < command.scans; ++i) {
    const Heap& heap = kHeaps[static_cast<std::size_t>(i) % std::size(kHeaps)];
    scene.clutter = heap.clutter, scene.objects_below = heap.above;
    scene.ground = heap.above ? "fenced" : "table";
    scene.elevation = 40 + 40.0 * ((i * 5) % 8) / 8;
    scene.azimuth = (i * 137) % 360;
    spec.scenes.push_back(scene);
  }
  return spec;
}

}  // namespace posevote::part
