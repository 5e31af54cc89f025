// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tools/part/part.hpp"

namespace posevote::part {
namespace {

constexpr int kClutter[] = {0, 4, 8, 14};  ///< bodies: from in full view to nearly buried
constexpr int kCopies = 2;                 ///< of one part in a scan; of several parts one each
constexpr double kRadius = 0.75;           ///< of the heap, x diagonal of the largest part
constexpr double kLargestClutter = 0.8;    ///< likewise

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
  // A heap of more bodies is as wide as it is high.
  scene.radius = kRadius * diagonal * std::max(1.0, static_cast<double>(scene.objects.size()) / 4);
  for (int i = 0; i < command.scans; ++i) {
    scene.clutter = kClutter[static_cast<std::size_t>(i) % std::size(kClutter)];
    scene.elevation = 40 + 40.0 * ((i * 5) % 8) / 8;
    scene.azimuth = (i * 137) % 360;
    spec.scenes.push_back(scene);
  }
  return spec;
}

}  // namespace posevote::part
