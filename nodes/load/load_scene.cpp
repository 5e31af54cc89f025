// SPDX-License-Identifier: BSD-3-Clause
// Loads the scan of a frame, in metres, in the sensor's frame: a point cloud or mesh, or a depth
// image, which becomes the points it measured. The file's ending says how it is read:
// nodes/formats/read_*.cpp.
//
// A depth image takes its camera from the data set; where that has none, from the parameters.
// Points that are NaN or infinite are left out. Linear in the size of the file. Fails, saying
// where, on files that are missing, damaged, cut off, or whose header claims more than they hold.
//
//   load_scene: {in: scene_file, out: raw_scan, unit: mm}
#include <string>

#include "graph/registry.hpp"
#include "nodes/data/files.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/load/read_depth.hpp"

namespace posevote::load {
namespace {

struct Params {
  std::string unit = "m";
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double depth_scale = 1;
  double min_depth = 0;
  double max_depth = 0;
};

std::string check(const Params& params) {
  if (params.max_depth > 0 && params.max_depth <= params.min_depth)
    return "max_depth must be greater than min_depth, or 0";
  return "";
}

Scan load_scene(const SceneFile& file, const Params& params) {
  if (!formats::has_ending(file.path, formats::Wanted::kDepthImages))
    return formats::read_scan(file.path, formats::metres_per(params.unit));
  const Camera given{params.fx, params.fy, params.cx, params.cy, params.depth_scale};
  return read_depth(file.path, file.camera.value_or(given), {params.min_depth, params.max_depth});
}

const auto registered =
    graph::register_node("load_scene", load_scene, "Loads a scan: point file or depth image.")
        .input("scene_file")
        .output("raw_scan")
        .param("unit", &Params::unit, "", "Unit of length in point files.",
               graph::one_of({"mm", "m"}))
        .param("fx", &Params::fx, "pixel", "Focal length, for depth images without a camera.",
               graph::at_least(0))
        .param("fy", &Params::fy, "pixel", "Focal length downward.", graph::at_least(0))
        .param("cx", &Params::cx, "pixel", "Principal point, from the left.")
        .param("cy", &Params::cy, "pixel", "Principal point, from the top.")
        .param("depth_scale", &Params::depth_scale, "mm", "Depth of one unit of a depth image.",
               graph::greater_than(0))
        .param("min_depth", &Params::min_depth, "m", "Nearer pixels of a depth image are left out.",
               graph::at_least(0))
        .param("max_depth", &Params::max_depth, "m",
               "Farther pixels of a depth image are left out; 0: no limit.", graph::at_least(0))
        .check(check);

}  // namespace
}  // namespace posevote::load
