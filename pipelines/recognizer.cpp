// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/recognizer.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "nodes/formats/raw_mesh.hpp"
#include "pipelines/configuration.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "pipelines/overrides.hpp"

namespace posevote {
namespace {

constexpr std::size_t kCornersOfFace = 3;

std::vector<formats::Triple> triples(const float* values, std::size_t count) {
  std::vector<formats::Triple> rows(count);
  for (std::size_t i = 0; i < count; ++i)
    rows[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return rows;
}

std::string model_name(const ObjectModel& model, std::size_t position) {
  if (!model.name.empty()) return model.name;
  if (!model.file.empty()) return std::filesystem::path(model.file).stem().string();
  return "model " + std::to_string(position + 1);
}

Mesh to_mesh(const ObjectModel& model) {
  const auto check_rows = [](std::size_t numbers, const std::string& what) {
    if (numbers % 3 != 0)
      throw std::invalid_argument(what + " are " + std::to_string(numbers) +
                                  " numbers, expected three a row");
  };
  check_rows(model.points.size(), "its points");
  check_rows(model.faces.size(), "its faces");
  if (!model.normals.empty() && model.normals.size() != model.points.size())
    throw std::invalid_argument("it has " + std::to_string(model.normals.size() / 3) +
                                " normals, expected one a point or none");
  formats::RawMesh raw;
  raw.points = triples(model.points.data(), model.points.size() / 3);
  raw.normals = triples(model.normals.data(), model.normals.size() / 3);
  for (std::size_t i = 0; i < model.faces.size(); i += kCornersOfFace) {
    for (std::size_t corner = i; corner < i + kCornersOfFace; ++corner)
      if (model.faces[corner] >= raw.points.size())
        throw std::invalid_argument("a face names point " + std::to_string(model.faces[corner]) +
                                    ", but there are " + std::to_string(raw.points.size()));
    raw.faces.push_back({model.faces[i], model.faces[i + 1], model.faces[i + 2]});
  }
  return formats::to_scan(raw, 1);
}

ModelFile model_file(const ObjectModel& model, std::size_t position) {
  const std::string name = model_name(model, position);
  if (model.file.empty() == model.points.empty())
    throw std::invalid_argument("the model '" + name + "': expected a file or points, one of them");
  ModelFile file;
  if (!model.file.empty()) {
    file = list_models({model.file}).front();
    const bool says_id = file.path.stem().string().starts_with("obj_");
    if (!says_id) file.obj_id = static_cast<int>(position + 1);
  } else {
    file.path = name;
    file.obj_id = static_cast<int>(position + 1);
    try {
      file.mesh = std::make_shared<const Mesh>(to_mesh(model));
    } catch (const std::exception& error) {
      throw std::invalid_argument("the model '" + name + "': " + error.what());
    }
  }
  file.name = name;
  if (model.obj_id > 0) file.obj_id = model.obj_id;
  return file;
}

ModelFiles model_files(const std::vector<ObjectModel>& models) {
  ModelFiles files;
  for (std::size_t i = 0; i < models.size(); ++i) files.push_back(model_file(models[i], i));
  if (files.empty()) throw std::invalid_argument("there are no models to look for");
  std::stable_sort(files.begin(), files.end(),
                   [](const ModelFile& a, const ModelFile& b) { return a.obj_id < b.obj_id; });
  for (std::size_t i = 1; i < files.size(); ++i)
    if (files[i].obj_id == files[i - 1].obj_id)
      throw std::invalid_argument("the models '" + files[i - 1].name + "' and '" + files[i].name +
                                  "' have one obj_id, " + std::to_string(files[i].obj_id));
  return files;
}

Configuration read_configuration(const RecognizerOptions& options) {
  std::vector<graph::Override> units = model_overrides(options.model_unit);
  for (graph::Override& change : scene_overrides(options.scene_unit, ""))
    units.push_back(std::move(change));
  Configuration configuration = load_configuration(options.config, options.set, {}, "", units);
  if (configuration.scenes.nodes.empty())
    throw std::invalid_argument(options.config + ": its pipeline makes models and finds none");
  return configuration;
}

Matrix4 to_matrix(const Eigen::Isometry3d& pose) {
  Matrix4 rows{};
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data()) = pose.matrix();
  return rows;
}

std::array<double, 3> to_array(const Eigen::Vector3f& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

std::array<double, 36> to_array(const Eigen::Matrix<double, 6, 6>& matrix) {
  std::array<double, 36> rows{};
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows.data()) = matrix;
  return rows;
}

FoundObject to_found(const Detection& detection) {
  FoundObject found;
  found.name = detection.model;
  found.obj_id = detection.obj_id;
  found.confidence = detection.confidence;
  found.pose_confidence = detection.pose_confidence();
  found.T_scene_model = to_matrix(detection.T_scene_model);
  if (detection.covariance) found.covariance = to_array(*detection.covariance);
  const Symmetries& symmetries = detection.symmetries;
  const Eigen::Vector3d fixed = symmetries.fixed_point.cast<double>();
  for (const Eigen::Quaternionf& turn : symmetries.turns)
    found.symmetries.push_back(
        to_matrix(Eigen::Translation3d(fixed) * turn.cast<double>().normalized() *
                  Eigen::Translation3d(-fixed)));
  for (const Eigen::Vector3f& axis : symmetries.axes) found.axes.push_back(to_array(axis));
  found.axis_point = to_array(symmetries.fixed_point);
  for (const LookAlike& other : detection.look_alikes)
    found.look_alikes.push_back(
        {to_matrix(detection.T_scene_model * other.motion), other.probability});
  found.inlier_share = detection.inlier_fraction;
  found.rms = detection.rmse;
  found.seconds = detection.seconds;
  return found;
}

SceneFile scene_of(const PointCloud& cloud) {
  if (cloud.count > 0 && !cloud.points) throw std::invalid_argument("the cloud's points are null");
  formats::RawMesh raw;
  raw.points = triples(cloud.points, cloud.count);
  if (cloud.normals) raw.normals = triples(cloud.normals, cloud.count);
  LoadedPoints loaded{formats::to_scan(raw, 1), cloud.sensor != nullptr};
  if (cloud.sensor)
    loaded.scan.view.origin = Eigen::Map<const Eigen::Vector3d>(cloud.sensor).cast<float>();
  SceneFile scene;
  scene.path = "the cloud";
  scene.points = std::make_shared<const LoadedPoints>(std::move(loaded));
  return scene;
}

SceneFile scene_of(const DepthView& image) {
  if ((image.metres == nullptr) == (image.raw == nullptr))
    throw std::invalid_argument("a depth image has depths in metres or raw ones, one of them");
  const std::size_t count = image.width * image.height;
  LoadedDepth loaded{image.width, image.height, {}};
  if (image.metres)
    loaded.depths.assign(image.metres, image.metres + count);
  else
    std::transform(image.raw, image.raw + count, std::back_inserter(loaded.depths),
                   [scale = image.millimetres_per_unit](std::uint16_t raw) {
                     return static_cast<float>(raw * scale * 0.001);
                   });
  SceneFile scene;
  scene.path = "the depth image";
  scene.camera = Camera{image.camera.fx, image.camera.fy, image.camera.cx, image.camera.cy, 1};
  scene.depth = std::make_shared<const LoadedDepth>(std::move(loaded));
  return scene;
}

}  // namespace

struct Recognizer::Parts {
  explicit Parts(const RecognizerOptions& options)
      : arena(static_cast<int>(options.threads > 0
                                   ? options.threads
                                   : std::max(1U, std::thread::hardware_concurrency()))),
        configuration(read_configuration(options)),
        seed(options.seed) {}

  mutable oneapi::tbb::task_arena arena;
  Configuration configuration;
  std::shared_ptr<const ModelLibrary> library;
  graph::Constants constants;
  std::uint64_t seed = 0;

  Recognition recognize(SceneFile scene) const;
};

Recognition Recognizer::Parts::recognize(SceneFile scene) const {
  const auto start = std::chrono::steady_clock::now();
  graph::FrameResult<Detections> result;
  arena.execute([&] {
    graph::FrameContext context;
    context.seed = seed;
    context.file = scene.path;
    result = graph::run_one(configuration.scenes, constants,
                            graph::Frame<SceneFile>{std::move(context), {std::move(scene)}});
  });
  if (result.failure) throw std::runtime_error(result.failure->node + ": " + result.failure->what);
  Recognition recognition;
  for (const Detection& detection : result.result->items)
    recognition.found.push_back(to_found(detection));
  std::stable_sort(
      recognition.found.begin(), recognition.found.end(),
      [](const FoundObject& a, const FoundObject& b) { return a.confidence > b.confidence; });
  for (const graph::Warning& warning : result.warnings)
    recognition.warnings.push_back(warning.what);
  recognition.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return recognition;
}

Recognizer::Recognizer(const std::vector<ObjectModel>& models, const RecognizerOptions& options)
    : parts_(std::make_unique<Parts>(options)) {
  const ModelFiles files = model_files(models);
  parts_->arena.execute([&] {
    parts_->library = cached_library(
        parts_->configuration, files,
        options.cache.empty() ? default_cache() : std::filesystem::path(options.cache));
    parts_->constants = constants_of(parts_->configuration, parts_->library);
  });
}

Recognizer::~Recognizer() = default;
Recognizer::Recognizer(Recognizer&&) noexcept = default;
Recognizer& Recognizer::operator=(Recognizer&&) noexcept = default;

Recognition Recognizer::recognize(const PointCloud& cloud) const {
  return parts_->recognize(scene_of(cloud));
}

Recognition Recognizer::recognize(const DepthView& image) const {
  return parts_->recognize(scene_of(image));
}

Recognition Recognizer::recognize_file(const std::string& file) const {
  SceneFile scene;
  scene.path = file;
  return parts_->recognize(std::move(scene));
}

std::vector<std::string> Recognizer::model_names() const {
  std::vector<std::string> names;
  for (const auto& model : parts_->library->models) names.push_back(model->name);
  return names;
}

std::string version() { return POSEVOTE_VERSION; }

}  // namespace posevote
