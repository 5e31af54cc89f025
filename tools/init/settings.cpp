// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/settings.hpp"

#include <charconv>

namespace posevote::init {

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::vector<std::string> Settings::sets() const {
  std::vector<std::string> sets{"load_models.unit=" + model_unit, "load_scene.unit=" + scene_unit};
  if (camera) {
    sets.push_back("load_scene.fx=" + number(camera->fx));
    sets.push_back("load_scene.fy=" + number(camera->fy));
    sets.push_back("load_scene.cx=" + number(camera->cx));
    sets.push_back("load_scene.cy=" + number(camera->cy));
    sets.push_back("load_scene.depth_scale=" + number(camera->depth_scale));
  }
  if (sensor)
    sets.push_back("load_scene.sensor_pose=[" + number(sensor->x()) + "," + number(sensor->y()) +
                   "," + number(sensor->z()) + "]");
  return sets;
}

}  // namespace posevote::init
