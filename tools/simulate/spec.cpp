// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/spec.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "graph/problem.hpp"
#include "graph/schema.hpp"
#include "nodes/formats/units.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/sensor_file.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/spec_reader.hpp"

namespace posevote {
namespace {

using graph::in_range;
using graph::Location;
using graph::make_param;
using graph::one_of;
using graph::ParamSpec;

const std::vector<ParamSpec>& model_params() {
  static const std::vector<ParamSpec> params{
      make_param<ModelSpec>("shape", &ModelSpec::shape, "", "Kind of object.",
                            one_of(shape_names())),
      make_param<ModelSpec>("file", &ModelSpec::file, "", "A mesh of one's own.", {}),
      make_param<ModelSpec>("unit", &ModelSpec::unit, "", "Unit of length in the file.",
                            one_of(formats::units_or_auto())),
      make_param<ModelSpec>("seed", &ModelSpec::seed, "", "Which one of that kind.",
                            in_range(0, 1e9)),
      make_param<ModelSpec>("size", &ModelSpec::size, "m", "Longest side.", in_range(0.02, 1)),
      make_param<ModelSpec>("x", &ModelSpec::x, "m", "Side along x.", in_range(0.005, 1)),
      make_param<ModelSpec>("y", &ModelSpec::y, "m", "Side along y.", in_range(0.005, 1)),
      make_param<ModelSpec>("z", &ModelSpec::z, "m", "Side along z.", in_range(0.005, 1))};
  return params;
}

const std::vector<ParamSpec>& scene_params() {
  static const std::vector<ParamSpec> params{
      make_param<SceneSpec>("count", &SceneSpec::count, "", "Images of this kind.",
                            in_range(1, 10000)),
      make_param<SceneSpec>("ground", &SceneSpec::ground, "", "What bodies lie on.",
                            one_of({"table", "bin", "fenced", "unseen"})),
      make_param<SceneSpec>("sensor", &SceneSpec::sensor, "", "Sensor.", {}),
      make_param<SceneSpec>("noise", &SceneSpec::noise, "m", "Deviation of ranges.",
                            in_range(0, 0.05)),
      make_param<SceneSpec>("inexact", &SceneSpec::inexact, "", "Objects differ from models.",
                            in_range(0, 0.2)),
      make_param<SceneSpec>("clutter", &SceneSpec::clutter, "", "Other bodies.", in_range(0, 50)),
      make_param<SceneSpec>("objects_below", &SceneSpec::objects_below, "", "Under the clutter.",
                            {}),
      make_param<SceneSpec>("radius", &SceneSpec::radius, "m", "Bodies drop inside.",
                            in_range(0.005, 5)),
      make_param<SceneSpec>("least_surface", &SceneSpec::least_surface, "", "Seen of each object.",
                            in_range(0, 0.5)),
      make_param<SceneSpec>("most_surface", &SceneSpec::most_surface, "", "Seen of each object.",
                            in_range(0.1, 1)),
      make_param<SceneSpec>("distance", &SceneSpec::distance, "m", "Sensor to table.",
                            in_range(0.1, 20)),
      make_param<SceneSpec>("elevation", &SceneSpec::elevation, "deg", "Above table.",
                            in_range(10, 90)),
      make_param<SceneSpec>("azimuth", &SceneSpec::azimuth, "deg", "Around table.",
                            in_range(-360, 360))};
  return params;
}

const std::vector<ParamSpec>& file_params() {
  static const std::vector<ParamSpec> params{
      make_param<Spec>("seed", &Spec::seed, "", "Poses and noise.", in_range(0, 1e9)),
      make_param<Spec>("colors", &Spec::colors, "", "Things are painted.", {}),
      make_param<Spec>("clutter_size", &Spec::clutter_size, "m", "Of the largest clutter.",
                       in_range(0.005, 2)),
      make_param<Spec>("least_visible", &Spec::least_visible, "", "Of instances that count.",
                       in_range(0, 1))};
  return params;
}

void read_objects(SpecReader& reader, const YAML::Node& map, const std::string& subject,
                  std::size_t models, SceneSpec& scene) {
  constexpr std::size_t kMost = 100;
  const std::vector<YAML::Node> items = reader.list(map, subject, "objects");
  if (items.size() > kMost) reader.report(map, subject + ".objects", "expected at most 100");
  for (const YAML::Node& item : items) {
    const auto obj_id =
        item.IsScalar() ? graph::Scalar<int>::parse(item.Scalar()) : std::optional<int>();
    if (!obj_id || *obj_id < 1 || static_cast<std::size_t>(*obj_id) > models)
      reader.report(item, subject + ".objects",
                    "expected the number of a model, 1 to " + std::to_string(models));
    else
      scene.objects.push_back(*obj_id);
  }
}

/// A path in the file, from where the file stands.
std::string from_folder_of(const std::string& spec, const std::string& path) {
  return (std::filesystem::path(spec).parent_path() / path).lexically_normal().string();
}

void check_model(SpecReader& reader, const YAML::Node& item, const std::string& subject,
                 ModelSpec& model) {
  if (!item.IsMap()) return;
  if (!model.file.empty() && !model.shape.empty())
    reader.report(item, subject, "has a shape and a file, expected one of them");
  if (model.file.empty() && !item["shape"].IsDefined())
    reader.report(item, subject + ".shape", "missing");
  const int sides = (model.x > 0) + (model.y > 0) + (model.z > 0);
  if (sides != 0 && sides != 3) reader.report(item, subject, "expected all of x, y, z or none");
  if (model.file.empty()) return;
  for (const char* key : {"seed", "size", "x", "y", "z"})
    if (item[key].IsDefined())
      reader.report(item[key], subject + "." + key, "is of shapes; a file is as large as it is");
  model.file = from_folder_of(reader.file, model.file);
}

void check_sensor(SpecReader& reader, const YAML::Node& item, const std::string& subject,
                  SceneSpec& scene) {
  const std::vector<std::string>& known = sensor_names();
  if (std::find(known.begin(), known.end(), scene.sensor) != known.end()) return;
  const std::string file = from_folder_of(reader.file, scene.sensor);
  if (std::filesystem::exists(file)) scene.sensor = file;
  try {
    read_sensor(scene.sensor);
  } catch (const std::exception& error) {
    const YAML::Node place = item["sensor"];
    reader.report(place.IsDefined() ? place : item, subject + ".sensor", error.what());
  }
}

Spec read_root(SpecReader& reader, const YAML::Node& root) {
  Spec spec;
  reader.read_map(root, "", file_params(), &spec, {"models", "scenes"});
  for (const YAML::Node& item : reader.list(root, "", "models")) {
    const std::string subject = "models[" + std::to_string(spec.models.size() + 1) + "]";
    ModelSpec& model = spec.models.emplace_back();
    reader.read_map(item, subject, model_params(), &model, {});
    check_model(reader, item, subject, model);
  }
  int number = 0;
  for (const YAML::Node& item : reader.list(root, "", "scenes")) {
    const std::string subject = "scenes[" + std::to_string(++number) + "]";
    SceneSpec scene;
    reader.read_map(item, subject, scene_params(), &scene, {"objects"});
    read_objects(reader, item, subject, spec.models.size(), scene);
    check_sensor(reader, item, subject, scene);
    spec.scenes.insert(spec.scenes.end(), static_cast<std::size_t>(std::max(1, scene.count)),
                       scene);
  }
  return spec;
}

}  // namespace

Spec read_spec(const std::string& file) {
  SpecReader reader{file, {}};
  const YAML::Node root = reader.load();
  Spec spec;
  if (reader.problems.empty()) {
    if (root.IsMap())
      spec = read_root(reader, root);
    else
      reader.report({file, 1, 1}, "", "expected a map with models and scenes");
  }
  if (!reader.problems.empty()) throw graph::ConfigError(std::move(reader.problems));
  return spec;
}

}  // namespace posevote
