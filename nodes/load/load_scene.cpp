// SPDX-License-Identifier: BSD-3-Clause
// Loads the scan of a frame, in metres, in the sensor's frame: a point cloud or mesh, or a depth
// image, which becomes the points it measured. The file's ending says how it is read:
// nodes/formats/read_*.cpp.
//
// A depth image takes its camera from the data set; where that has none, from the parameters.
// A point file may be in another frame than its sensor's, a robot's or a turntable's. Where the
// sensor stood there is what `sensor_pose` says, else the file NAME.pose beside NAME.ply, else a
// PCD's VIEWPOINT, else the origin. The poses that are found are in the frame of the file.
//
// Where nothing says it, the scan is asked whether it can be the origin. Where the file has normals,
// most must point there, or the sensor is taken to have stood where most of them do point. A scan
// that cannot be told so gets a warning. So do a pose that the normals contradict, and normals that
// all point away from the origin, from where all is seen: they are inverted, and estimate_normals
// turns them.
//
// Colours come with the points of a file, or from the colour image beside a depth image. Such that
// cannot be read, or do not fit, are left out with a warning, as is an image that shows something
// else than the depth image measured (edge_match.hpp).
//
// Points that are NaN or infinite are left out. Linear in the size of the file. Fails, saying
// where, on files that are missing, damaged, cut off, or whose header claims more than they hold.
//
//   load_scene: {in: scene_file, out: raw_scan, unit: mm, sensor_pose: [0, -400, 650]}
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/data/files.hpp"
#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/sensor_pose.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/geometry/extent.hpp"
#include "nodes/geometry/viewpoint.hpp"
#include "nodes/load/edge_match.hpp"
#include "nodes/load/read_depth.hpp"

namespace posevote::load {
namespace {

struct Params {
  std::string unit = "m";
  std::vector<double> sensor_pose;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double depth_scale = 1;
  double min_depth = 0;
  double max_depth = 0;
  int max_points = 50'000'000;
  bool colors = true;
  bool check_colors = true;
};

std::string check(const Params& params) {
  if (params.max_depth > 0 && params.max_depth <= params.min_depth)
    return "max_depth must be greater than min_depth, or 0";
  try {
    if (!params.sensor_pose.empty()) formats::sensor_pose(params.sensor_pose);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

Eigen::Isometry3d read_pose(const std::filesystem::path& file) {
  try {
    return formats::sensor_pose(formats::read_pose_numbers(formats::read_file(file).view()));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

/// Where the sensor stood, if that is said outside the file, in the file's unit.
std::optional<Eigen::Vector3d> said_viewpoint(const SceneFile& file, const Params& params) {
  if (file.points && file.points->knows_sensor) return file.points->scan.view.origin.cast<double>();
  if (!params.sensor_pose.empty()) return formats::sensor_pose(params.sensor_pose).translation();
  if (file.points) return std::nullopt;
  const std::filesystem::path beside = formats::pose_file_of(file.path);
  if (std::filesystem::exists(std::filesystem::symlink_status(beside)))
    return read_pose(beside).translation();
  return std::nullopt;
}

constexpr double kFacing = 0.7;  ///< share of normals: with less the sensor stood elsewhere
constexpr double kFound = 0.9;   ///< share of normals that point to a place where it did stand
constexpr double kInverted = 0.02;

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

std::string in_metres(const Eigen::Vector3f& place) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.3g, %.3g, %.3g) m", static_cast<double>(place.x()),
                static_cast<double>(place.y()), static_cast<double>(place.z()));
  return text;
}

/// Looks for the sensor where nobody says where it stood and the normals contradict the origin.
/// Returns what to tell the user.
std::string find_viewpoint(Scan& scan, double facing) {
  const std::string normals =
      "only " + percent(facing) + " of the file's normals point to the origin";
  const std::string say = "; say by --sensor-pose where the sensor stood";
  const Eigen::Vector3f place = geometry::estimate_viewpoint(scan);
  const bool may_be_inverted =
      facing <= kInverted && geometry::lies_before(scan.points, scan.view.origin);
  if (may_be_inverted &&
      geometry::share_hidden(scan, scan.view.origin) <= geometry::share_hidden(scan, place))
    return normals + ": taken as inverted" + say + " if not there";
  const double share = *geometry::share_facing(scan, place);
  if (share < kFound)
    return normals + ", nor do they to any one place; they are turned to the origin" + say +
           ", or, of a whole body, --set estimate_normals.outward=true";
  scan.view.origin = place;
  return normals + ": the sensor is taken to have stood at about " + in_metres(place) + ", where " +
         percent(share) + " point" + say + " exactly";
}

/// Whether the viewpoint can be right; where nobody said it, mends what can be mended. Returns what
/// to tell the user, "" where all is well.
std::string check_viewpoint(Scan& scan, bool is_said) {
  const std::optional<double> facing = geometry::share_facing(scan, scan.view.origin);
  if (facing && *facing >= kFacing) return "";
  if (is_said)
    return facing ? "only " + percent(*facing) + " of the file's normals point to the sensor at " +
                        in_metres(scan.view.origin) +
                        ": is its pose that of the sensor in the scan's frame, and in its unit?"
                  : "";
  if (facing) return find_viewpoint(scan, *facing);
  if (geometry::lies_before(scan.points, scan.view.origin)) return "";
  return "the scan lies around its frame's origin, so the sensor hardly stood there; say where it "
         "did by --sensor-pose (--sensor-pose '0 0 0' if there)";
}

/// The points, in metres.
Scan read_points(const SceneFile& file, double metres, const formats::Warn& warn = {}) {
  if (!file.points) return formats::read_scan(file.path, metres, warn);
  Scan scan = file.points->scan;
  scan.points = (scan.points.cast<double>() * metres).cast<float>();
  scan.view.origin = (scan.view.origin.cast<double>() * metres).cast<float>();
  return scan;
}

/// The unit in which the scan is of a size that scans have.
std::string likely_unit(const SceneFile& file, const graph::FrameContext& context) {
  constexpr double kLeastInMillimetres = 30;  // the largest scenes in m, the smallest in mm
  constexpr double kOutliers = 0.02;
  const Scan scan = read_points(file, 1);
  if (scan.points.rows() == 0) return "m";  // refused later
  const formats::LikelyUnit likely =
      formats::likely_unit(geometry::robust_diagonal(scan.points, kOutliers), kLeastInMillimetres);
  if (!likely.doubt.empty())
    context.warn("the scan: " + likely.doubt + "; say --scene-unit (load_scene.unit)");
  return likely.unit;
}

Scan load_points(const SceneFile& file, const graph::FrameContext& context, const Params& params) {
  const double metres =
      formats::metres_per(params.unit == "auto" ? likely_unit(file, context) : params.unit);
  const std::optional<Eigen::Vector3d> viewpoint = said_viewpoint(file, params);
  Scan scan = read_points(file, metres, [&](const std::string& what) { context.warn(what); });
  if (viewpoint) scan.view.origin = (*viewpoint * metres).cast<float>();
  if (!scan.view.origin.allFinite())
    throw std::runtime_error("the sensor's pose is too far away to be told in metres");
  const std::string doubt = check_viewpoint(scan, viewpoint || !scan.view.origin.isZero());
  if (!doubt.empty()) context.warn(doubt);
  return scan;
}

/// Those of the image or of the file beside it, but for such as cannot be right; else null.
std::shared_ptr<const ColorImage> find_colors(const SceneFile& file,
                                              const graph::FrameContext& context,
                                              const Params& params, const LoadedDepth& image) {
  if (!params.colors) return nullptr;
  try {
    auto color = file.color.empty() ? image.color : read_colors(file.color, image);
    if (color && params.check_colors && !is_of_one_view(match_edges(image, *color)))
      throw std::runtime_error(
          "does not show what the depth image measured: where the depth steps, its edges match no "
          "better than when it is shifted. It seems to be of another moment, or not registered to "
          "the depth image (load_scene.check_colors=false takes it nevertheless)");
    return color;
  } catch (const std::runtime_error& error) {
    const std::filesystem::path folder = file.color.parent_path().filename();
    const std::string name =
        file.color.empty() ? "the colour image" : (folder / file.color.filename()).string() + ":";
    context.warn("its colours are left out: " + name + " " + error.what());
    return nullptr;
  }
}

Scan load_file(const SceneFile& file, const graph::FrameContext& context, const Params& params) {
  if (file.points ||
      (!file.depth && !formats::has_ending(file.path, formats::Wanted::kDepthImages)))
    return load_points(file, context, params);
  if (!params.sensor_pose.empty())
    throw std::runtime_error(
        "a depth image is in its sensor's own frame: load_scene.sensor_pose (--sensor-pose) is for "
        "point files");
  const Camera given{params.fx, params.fy, params.cx, params.cy, params.depth_scale};
  Camera camera = file.camera.value_or(given);
  if (camera.depth_scale == 0) camera.depth_scale = params.depth_scale;
  const DepthRange range{params.min_depth, params.max_depth,
                         static_cast<std::size_t>(params.max_points)};
  const auto image =
      file.depth ? file.depth
                 : std::make_shared<const LoadedDepth>(read_depth(file.path, camera, range));
  return points_of(*image, find_colors(file, context, params, *image).get(), camera, range);
}

Scan load_scene(const SceneFile& file, const graph::FrameContext& context, const Params& params) {
  Scan scan = load_file(file, context, params);
  if (scan.points.rows() > params.max_points)
    throw std::runtime_error("has " + std::to_string(scan.points.rows()) +
                             " points, more than the " + std::to_string(params.max_points) +
                             " that memory is granted for (load_scene.max_points, --memory)");
  if (!params.colors) scan.colors.resize(0, 3);
  const Eigen::Vector3d place = scan.view.origin.cast<double>();
  context.tell("sensor_pose", {place.x(), place.y(), place.z()});
  return scan;
}

const auto registered =
    graph::register_node("load_scene", load_scene, "Loads a scan: point file or depth image.")
        .input("scene_file")
        .output("raw_scan")
        .param("unit", &Params::unit, "",
               "Unit of length in point files; auto: m or mm, by their size.",
               graph::one_of(formats::units_or_auto()))
        .param("sensor_pose", &Params::sensor_pose, "",
               "Where the sensor stood in the frame of a point file, in the file's unit: x y z; or "
               "x y z qx qy qz qw; or a 4 x 4 matrix row by row. Empty: NAME.pose beside the scan, "
               "a PCD's VIEWPOINT, or the origin.")
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
        .param("max_points", &Params::max_points, "",
               "A scan of more points or pixels fails; one takes up to 64 bytes of memory.",
               graph::at_least(1))
        .param("colors", &Params::colors, "",
               "Whether colours are read, of the file or of the image beside it. Colour tells what "
               "shape cannot, of models that have colours, too.")
        .param("check_colors", &Params::check_colors, "",
               "Whether a colour image is left out that does not show what the depth image "
               "measured: its edges do not lie where the depth steps.")
        .check(check);

}  // namespace
}  // namespace posevote::load
