// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/look.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "graph/registry.hpp"
#include "nodes/formats/format.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/sensor_pose.hpp"
#include "nodes/geometry/extent.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/outward_normals.hpp"
#include "nodes/geometry/sensor_noise.hpp"
#include "nodes/geometry/viewpoint.hpp"
#include "nodes/geometry/winding.hpp"
#include "tools/init/settings.hpp"

namespace posevote::init {
namespace {

namespace fs = std::filesystem;

constexpr double kStrays = 0.02;  ///< share of the points at either end of each axis

/// Of the pairs of normals that are there on both sides, the share that look the same way.
std::optional<double> share_agreeing(const PointMatrix& a, const PointMatrix& b) {
  if (a.rows() != b.rows()) return std::nullopt;
  Eigen::Index pairs = 0, agree = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const float cosine = a.row(i).dot(b.row(i));
    if (cosine == 0) continue;
    ++pairs, agree += cosine > 0 ? 1 : 0;
  }
  if (pairs == 0) return std::nullopt;
  return static_cast<double>(agree) / static_cast<double>(pairs);
}

void look_at_faces(const Mesh& mesh, ModelLook& look) {
  const geometry::WoundFaces wound = geometry::wind_parts(mesh.points, mesh.faces);
  look.parts = wound.parts.size();
  look.open_edges = wound.open_edges.size();
  const auto same = share_agreeing(geometry::face_normals(mesh.points, mesh.faces),
                                   geometry::face_normals(mesh.points, wound.faces));
  look.turned = same ? 1 - *same : 0;
}

/// What a point file's header says of rows and columns: a PCD's WIDTH and HEIGHT, a range grid's
/// num_cols and num_rows in a PLY. 0 x 0 where its points are in no grid.
void look_at_grid(const fs::path& file, ScanLook& look) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  for (int i = 0; i < 200 && std::getline(stream, line); ++i) {
    if (line.starts_with("end_header") || line.starts_with("DATA")) break;
    std::istringstream words(line.starts_with("obj_info ") ? line.substr(9) : line);
    std::string key;
    std::size_t value = 0;
    if (!(words >> key >> value)) continue;
    if (key == "WIDTH" || key == "num_cols") look.width = value;
    if (key == "HEIGHT" || key == "num_rows") look.height = value;
  }
  if (look.height < 2 || look.width < 2) look.width = look.height = 0;
}

std::string why(const std::exception& error) { return error.what(); }

void measure(const Scan& scan, ScanLook& look) {
  look.points = static_cast<std::size_t>(scan.points.rows());
  if (look.points == 0) throw std::runtime_error("the scan has no points");
  for (int axis = 0; axis < 3; ++axis)
    look.sides[axis] = geometry::robust_extent(scan.points, axis, kStrays);
  look.diagonal = look.sides.norm();
  look.sensor = scan.view.origin.cast<double>();
  look.lies_before = geometry::lies_before(scan.points, scan.view.origin);
  look.facing = geometry::share_facing(scan, scan.view.origin);
  const geometry::SensorNoise noise = geometry::measure_noise(scan.points, scan.view.origin);
  look.range = static_cast<double>(noise.median_range);
  look.spacing = static_cast<double>(noise.spacing_at(noise.median_range));
  look.noise = static_cast<double>(noise.noise_at(noise.median_range));
}

}  // namespace

ModelLook look_at_model(const ModelFile& model) {
  ModelLook look;
  look.file = model.path, look.name = model.name;
  try {
    const Mesh mesh = formats::read_mesh(model.path, 1);
    look.points = static_cast<std::size_t>(mesh.points.rows());
    look.faces = static_cast<std::size_t>(mesh.faces.rows());
    look.diagonal = geometry::model_diagonal(mesh.points);
    look.sides = (mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff())
                     .transpose()
                     .cast<double>();
    if (look.faces > 0) look_at_faces(mesh, look);
    if (mesh.normals.rows() > 0)
      look.outward = share_agreeing(mesh.normals, geometry::outward_normals(mesh, {}));
  } catch (const std::exception& error) {
    look.unreadable = why(error);
  }
  return look;
}

LoadedScan load_scan(const SceneFile& scan, const std::vector<std::string>& sets) {
  const graph::NodeSpec& node = *graph::find_node("load_scene");
  const std::shared_ptr<void> params = node.make_params();
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    for (const graph::ParamSpec& param : node.params)
      if (param.name == set.substr(0, equals)) param.set(params.get(), set.substr(equals + 1));
  }
  LoadedScan loaded;
  graph::FrameContext context;
  context.file = scan.path;
  context.on_warning = [&](const std::string& what) { loaded.warnings.push_back(what); };
  const std::vector<graph::Value> out =
      node.call({graph::StreamTraits<SceneFile>::wrap(SceneFile(scan))}, context, params.get());
  loaded.scan = graph::StreamTraits<Scan>::unwrap(out.at(0));
  return loaded;
}

ScanLook look_at_scan(const SceneFile& scan, const std::optional<Camera>& camera) {
  ScanLook look;
  look.file = scan.path;
  look.is_depth = formats::has_ending(scan.path, formats::Wanted::kDepthImages);
  try {
    SceneFile file = scan;
    if (look.is_depth && camera) file.camera = camera, file.camera->depth_scale = 1;
    Scan loaded;
    if (look.is_depth) {
      loaded = load_scan(file, {}).scan;
      look.width = static_cast<std::size_t>(loaded.view.pixels.x());
      look.height = static_cast<std::size_t>(loaded.view.pixels.y());
    } else {
      // As it is in the file: load_scene would look for the sensor where the normals point.
      loaded = formats::read_scan(scan.path, 1);
      look_at_grid(scan.path, look);
      const fs::path beside = formats::pose_file_of(scan.path);
      look.says_sensor = fs::exists(beside) || !loaded.view.origin.isZero();
      if (fs::exists(beside)) loaded.view = load_scan(file, {"unit=m"}).scan.view;
    }
    measure(loaded, look);
  } catch (const std::exception& error) {
    look.unreadable = why(error);
  }
  return look;
}

}  // namespace posevote::init
