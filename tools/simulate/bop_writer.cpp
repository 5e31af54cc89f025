// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/bop_writer.hpp"

#include <cmath>
#include <map>

#include "nodes/formats/color_image.hpp"
#include "nodes/formats/write_ply.hpp"
#include "nodes/formats/write_png.hpp"
#include "nodes/geometry/extreme_points.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char *kModels = "models", *kSplit = "test", *kScans = "scans",
                     *kTargets = "test_targets_bop19.json";
constexpr int kSceneId = 1;

std::string six_digits(int number) {
  char text[16];
  std::snprintf(text, sizeof text, "%06d", number);
  return text;
}

/// `{"key": [...], ...}` with one key a line, as BOP's own files.
std::string lines(const ordered_json& json) {
  std::string text = "{";
  for (const auto& [key, value] : json.items())
    text += (text.size() > 1 ? ",\n  \"" : "\n  \"") + key + "\": " + value.dump();
  return text + "\n}\n";
}

/// In mm. Of a paint as much as the mesh can carry: an image, or a colour a vertex where there are
/// many.
void write_model(const fs::path& file, const Mesh& mesh, const Paint* paint) {
  constexpr Eigen::Index kManyFaces = 3000;
  if (!paint) return formats::write_ply(file, mesh, 1000);
  if (mesh.faces.rows() > kManyFaces)
    return formats::write_ply(file, mesh, 1000, paint_points(mesh, *paint));
  const PaintedFaces painted = paint_faces(mesh, *paint);
  const fs::path image = fs::path(file).replace_extension(".png");
  formats::write_png(image, painted.image.width, painted.image.height, PNG_FORMAT_RGB,
                     painted.image.values.data());
  formats::write_ply(file, mesh, 1000, {}, {image.filename().string(), painted.places});
}

/// Rounded to 1e-9: beyond, mathematics libraries differ, and files should not.
double rounded(double value) { return std::round(value * 1e9) / 1e9 + 0.0; }

ordered_json list(const Eigen::Vector3d& v) {
  return {rounded(v.x()), rounded(v.y()), rounded(v.z())};
}

ordered_json box(const PixelBox& box) { return {box.x, box.y, box.width, box.height}; }

/// A turn about a place [m] as BOP writes transforms: 4 x 4, in mm.
ordered_json row_by_row(const Eigen::Matrix3d& turn, const Eigen::Vector3d& center) {
  const Eigen::Vector3d offset = 1000 * (center - turn * center);
  ordered_json list;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) list.push_back(rounded(turn(row, column)));
    list.push_back(rounded(offset[row]));
  }
  for (const double value : {0.0, 0.0, 0.0, 1.0}) list.push_back(value);
  return list;
}

ordered_json pose(const Body& body, const Eigen::Isometry3d& T_world_sensor) {
  const Eigen::Isometry3d T_sensor_model = T_world_sensor.inverse() * body.T_world_body;
  std::vector<double> rotation, translation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rotation.push_back(rounded(T_sensor_model.linear()(row, column)));
    translation.push_back(rounded(T_sensor_model.translation()[row] * 1000));
  }
  return {{"cam_R_m2c", rotation}, {"cam_t_m2c", translation}, {"obj_id", body.obj_id}};
}

ordered_json info(const BodyView& view) {
  return {{"bbox_obj", box(view.box_alone)},
          {"bbox_visib", box(view.box_visible)},
          {"px_count_all", view.alone},
          {"px_count_valid", view.valid},
          {"px_count_visib", view.visible},
          {"surface_fract", rounded(view.surface)},
          {"visib_fract", rounded(view.fraction())}};
}

}  // namespace

BopWriter::BopWriter(fs::path out, double least_visible)
    : out_(std::move(out)), least_visible_(least_visible) {
  for (const fs::path& folder :
       {out_ / kModels, out_ / kSplit / six_digits(kSceneId) / "depth", out_ / kScans})
    fs::create_directories(folder);  // std::filesystem_error is a runtime_error that names it
}

void BopWriter::add_model(int obj_id, const Mesh& mesh, const ShapeSymmetry& symmetry,
                          const Paint* paint) {
  write_model(out_ / kModels / ("obj_" + six_digits(obj_id) + ".ply"), mesh, paint);
  ordered_json entry{{"diameter", rounded(geometry::diameter_of(mesh.points) * 1000)}};
  const Eigen::RowVector3f low = mesh.points.colwise().minCoeff();
  const Eigen::RowVector3f size = mesh.points.colwise().maxCoeff() - low;
  const std::string axes[3] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) entry["min_" + axes[axis]] = rounded(low[axis] * 1000.0);
  for (int axis = 0; axis < 3; ++axis) entry["size_" + axes[axis]] = rounded(size[axis] * 1000.0);
  if (symmetry.is_round)
    entry["symmetries_continuous"] = {{{"axis", {0, 0, 1}}, {"offset", {0, 0, 0}}}};
  for (const Eigen::Vector3d& axis : symmetry.axes)
    entry["symmetries_continuous"].push_back(
        {{"axis", list(axis)}, {"offset", list(1000 * symmetry.center)}});
  for (const Eigen::Matrix3d& turn : symmetry.turns)
    entry["symmetries_discrete"].push_back(row_by_row(turn, symmetry.center));
  models_info_[std::to_string(obj_id)] = entry;
}

void BopWriter::add_image(const std::vector<Body>& bodies, const Sensor& sensor,
                          const Eigen::Isometry3d& T_world_sensor, const SimulatedScan& scan) {
  const int im_id = images_++;
  const std::string key = std::to_string(im_id), name = six_digits(im_id);
  const Camera& camera = sensor.camera;
  formats::write_png(out_ / kSplit / six_digits(kSceneId) / "depth" / (name + ".png"),
                     scan.depth.width, scan.depth.height, PNG_FORMAT_LINEAR_Y,  // 16-bit grey
                     scan.depth.values.data());
  if (!scan.colors.values.empty()) {
    constexpr int kQuality = 92;
    const fs::path folder = out_ / kSplit / six_digits(kSceneId) / "rgb";
    fs::create_directories(folder);
    formats::write_jpeg(scan.colors, kQuality, folder / (name + ".jpg"));
  }
  formats::write_ply(out_ / kScans / (name + ".ply"), points_of(scan.depth, camera));
  cameras_[key] = {{"cam_K", {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0}},
                   {"depth_scale", camera.depth_scale}};
  gt_[key] = gt_info_[key] = ordered_json::array();
  std::map<int, int> seen;  // instances by obj_id
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].obj_id == 0) continue;
    gt_[key].push_back(pose(bodies[i], T_world_sensor));
    gt_info_[key].push_back(info(scan.views[i]));
    if (scan.views[i].fraction() >= least_visible_) ++seen[bodies[i].obj_id];
  }
  for (const auto& [obj_id, count] : seen)
    targets_.push_back(
        {{"im_id", im_id}, {"inst_count", count}, {"obj_id", obj_id}, {"scene_id", kSceneId}});
}

void BopWriter::finish() const {
  const fs::path scene = out_ / kSplit / six_digits(kSceneId);
  write_text(out_ / kModels / "models_info.json", lines(models_info_));
  write_text(scene / "scene_camera.json", lines(cameras_));
  write_text(scene / "scene_gt.json", lines(gt_));
  write_text(scene / "scene_gt_info.json", lines(gt_info_));
  write_text(out_ / kTargets, targets_.dump(1) + "\n");
}

bool BopWriter::makes(const fs::path& name) {
  return name == kModels || name == kSplit || name == kScans || name == kTargets;
}

}  // namespace posevote
