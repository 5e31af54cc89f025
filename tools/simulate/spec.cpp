// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/spec.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "graph/problem.hpp"
#include "graph/schema.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/shapes.hpp"

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
                            one_of({"table", "bin", "unseen"})),
      make_param<SceneSpec>("sensor", &SceneSpec::sensor, "", "Sensor.", one_of(sensor_names())),
      make_param<SceneSpec>("noise", &SceneSpec::noise, "m", "Deviation of ranges.",
                            in_range(0, 0.05)),
      make_param<SceneSpec>("inexact", &SceneSpec::inexact, "", "Objects differ from models.",
                            in_range(0, 0.2)),
      make_param<SceneSpec>("clutter", &SceneSpec::clutter, "", "Other bodies.", in_range(0, 50)),
      make_param<SceneSpec>("radius", &SceneSpec::radius, "m", "Bodies drop inside.",
                            in_range(0.01, 1)),
      make_param<SceneSpec>("least_surface", &SceneSpec::least_surface, "", "Seen of each object.",
                            in_range(0, 0.5)),
      make_param<SceneSpec>("most_surface", &SceneSpec::most_surface, "", "Seen of each object.",
                            in_range(0.1, 1)),
      make_param<SceneSpec>("distance", &SceneSpec::distance, "m", "Sensor to table.",
                            in_range(0.3, 3)),
      make_param<SceneSpec>("elevation", &SceneSpec::elevation, "deg", "Above table.",
                            in_range(10, 90)),
      make_param<SceneSpec>("azimuth", &SceneSpec::azimuth, "deg", "Around table.",
                            in_range(-360, 360))};
  return params;
}

const std::vector<ParamSpec>& file_params() {
  static const std::vector<ParamSpec> params{
      make_param<Spec>("seed", &Spec::seed, "", "Poses and noise.", in_range(0, 1e9)),
      make_param<Spec>("least_visible", &Spec::least_visible, "", "Of instances that count.",
                       in_range(0, 1))};
  return params;
}

/// Reads one file; what is wrong goes to `problems`.
struct Reader {
  std::string file;
  std::vector<graph::Problem> problems;

  Location at(const YAML::Mark& mark) const { return {file, mark.line + 1, mark.column + 1}; }
  void report(const Location& where, const std::string& subject, const std::string& text) {
    problems.push_back({where, subject, text});
  }
  void report(const YAML::Node& node, const std::string& subject, const std::string& text) {
    report(at(node.Mark()), subject, text);
  }

  YAML::Node load() {
    try {
      if (!std::filesystem::is_directory(file)) return YAML::LoadFile(file);
      report({file, 0, 0}, "", "is a folder, expected a YAML file");
    } catch (const YAML::BadFile&) {
      report({file, 0, 0}, "", "cannot be read: no such file?");
    } catch (const YAML::Exception& error) {
      report(at(error.mark), "", "is not valid YAML: " + error.msg);
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  /// Reads a map: plain values by `params` into `target`, `lists` are left to the caller.
  void read_map(const YAML::Node& map, const std::string& subject,
                const std::vector<ParamSpec>& params, void* target,
                const std::vector<std::string>& lists);
  void read_value(const YAML::Node& value, const std::string& subject, const ParamSpec& param,
                  void* target);
  /// The entries of a list; an empty or missing one is a problem.
  std::vector<YAML::Node> list(const YAML::Node& map, const std::string& subject,
                               const std::string& key);
};

void Reader::read_value(const YAML::Node& value, const std::string& subject, const ParamSpec& param,
                        void* target) {
  if (!value.IsScalar()) return report(value, subject, "expected one plain value");
  if (const auto problem = param.set(target, value.Scalar()))
    report(value, subject, "is '" + value.Scalar() + "', " + *problem);
}

void Reader::read_map(const YAML::Node& map, const std::string& subject,
                      const std::vector<ParamSpec>& params, void* target,
                      const std::vector<std::string>& lists) {
  if (!map.IsMap()) return report(map, subject, "expected {key: value ...}");
  std::vector<std::string> known = lists;
  for (const ParamSpec& param : params) known.push_back(param.name);
  std::map<std::string, int> line_of;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const std::string name = subject.empty() ? key : std::string(subject).append(".").append(key);
    const auto [first, is_new] = line_of.emplace(key, entry.first.Mark().line + 1);
    const auto param = std::find_if(params.begin(), params.end(),
                                    [&](const ParamSpec& other) { return other.name == key; });
    if (!is_new) {
      report(entry.first, name, "given twice, first in line " + std::to_string(first->second));
    } else if (param != params.end()) {
      read_value(entry.second, name, *param, target);
    } else if (std::find(lists.begin(), lists.end(), key) == lists.end()) {
      const std::string near = graph::closest_name(key, known);
      report(entry.first, name,
             "unknown key" + (near.empty() ? "" : ", did you mean '" + near + "'?"));
    }
  }
}

std::vector<YAML::Node> Reader::list(const YAML::Node& map, const std::string& subject,
                                     const std::string& key) {
  const std::string name = subject.empty() ? key : subject + "." + key;
  const YAML::Node node = map.IsMap() ? map[key] : YAML::Node(YAML::NodeType::Undefined);
  if (!node.IsDefined()) {
    if (map.IsMap()) report(map, name, "missing, expected a list");
    return {};
  }
  if (!node.IsSequence() || node.size() == 0) {
    report(node.IsNull() ? map : node, name, "expected a list of at least one");
    return {};
  }
  return {node.begin(), node.end()};
}

void read_objects(Reader& reader, const YAML::Node& map, const std::string& subject,
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

Spec read_root(Reader& reader, const YAML::Node& root) {
  Spec spec;
  reader.read_map(root, "", file_params(), &spec, {"models", "scenes"});
  for (const YAML::Node& item : reader.list(root, "", "models")) {
    const std::string subject = "models[" + std::to_string(spec.models.size() + 1) + "]";
    ModelSpec& model = spec.models.emplace_back();
    reader.read_map(item, subject, model_params(), &model, {});
    if (item.IsMap() && !item["shape"].IsDefined())
      reader.report(item, subject + ".shape", "missing");
    const int sides = (model.x > 0) + (model.y > 0) + (model.z > 0);
    if (sides != 0 && sides != 3) reader.report(item, subject, "expected all of x, y, z or none");
  }
  int number = 0;
  for (const YAML::Node& item : reader.list(root, "", "scenes")) {
    const std::string subject = "scenes[" + std::to_string(++number) + "]";
    SceneSpec scene;
    reader.read_map(item, subject, scene_params(), &scene, {"objects"});
    read_objects(reader, item, subject, spec.models.size(), scene);
    spec.scenes.insert(spec.scenes.end(), static_cast<std::size_t>(std::max(1, scene.count)),
                       scene);
  }
  return spec;
}

}  // namespace

Spec read_spec(const std::string& file) {
  Reader reader{file, {}};
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
