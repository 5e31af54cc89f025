// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "nodes/formats/units.hpp"
#include "tools/init/init.hpp"
#include "tools/text.hpp"

namespace posevote::init {
namespace {

/// "    unit: mm   # why"
std::string line(const std::string& setting, const std::string& why) {
  return "  " + setting + std::string(setting.size() < 28 ? 28 - setting.size() : 1, ' ') + "# " +
         why + "\n";
}

/// From the least to the greatest, as they are read.
std::string sizes(std::vector<double> file_sizes, double metres) {
  if (file_sizes.empty()) return "";
  const auto [least, most] = std::minmax_element(file_sizes.begin(), file_sizes.end());
  if (*least == *most) return format("%.4g across: %.4g m", *least, *least * metres);
  return format("%.4g to %.4g across: %.4g to %.4g m", *least, *most, *least * metres,
                *most * metres);
}

template <class Looks>
std::vector<double> diagonals(const Looks& looks, bool depth) {
  std::vector<double> all;
  for (const auto& look : looks) {
    if (!look.unreadable.empty()) continue;
    if constexpr (requires { look.is_depth; })
      if (look.is_depth != depth) continue;
    all.push_back(look.diagonal);
  }
  return all;
}

std::string point_lines(const Report& report, const std::vector<double>& seen) {
  const Settings& s = report.settings;
  std::string text = line("unit: " + s.scene_unit,
                          "of point files: " + sizes(seen, formats::metres_per(s.scene_unit)));
  if (s.sensor)
    return text + line("sensor_pose: [" + number(s.sensor->x()) + ", " + number(s.sensor->y()) +
                           ", " + number(s.sensor->z()) + "]",
                       "where the sensor stood, roughly, in the scans' frame and unit; better: "
                       "the exact place");
  return text +
         "  # sensor_pose: [0, 0, 0]   # where the sensor stood, in the scans' frame and unit; "
         "without it: NAME.pose\n"
         "  #                          # beside NAME.ply, a PCD's VIEWPOINT, where the normals "
         "point, or the origin\n";
}

std::string depth_lines(const Report& report) {
  const Camera& camera = *report.settings.camera;
  return line("fx: " + number(camera.fx), report.camera_from) + "  fy: " + number(camera.fy) +
         "\n  cx: " + number(camera.cx) + "\n  cy: " + number(camera.cy) + "\n" +
         line("depth_scale: " + number(camera.depth_scale),
              format("mm of one unit of a depth image; %.5g units to the metre",
                     1000 / camera.depth_scale));
}

}  // namespace

std::string config_text(const Report& report) {
  const Settings& s = report.settings;
  const std::vector<double> points = diagonals(report.scans, false);
  std::string text =
      "# Made by `posevote init`. Only what these data need beside the defaults; `posevote nodes "
      "NAME` lists all else.\n# " +
      report.run + "\npipeline: recognize\nload_models:\n" +
      line("unit: " + s.model_unit, "of model files: " + sizes(diagonals(report.models, false),
                                                               formats::metres_per(s.model_unit))) +
      "load_scene:\n";
  if (!points.empty()) text += point_lines(report, points);
  if (s.camera) text += depth_lines(report);
  return text +
         "# write_picture: {every: 1}        # a picture of each scan with what was found\n"
         "# segment_objects: {max_instances: 1}   # if no scan holds an object twice\n";
}

}  // namespace posevote::init
