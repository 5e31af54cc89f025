// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/configuration.hpp"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "graph/did_you_mean.hpp"
#include "graph/plugin.hpp"
#include "graph/wiring.hpp"
#include "graph/yaml_reader.hpp"
#include "pipelines/installed.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using graph::Override;
using graph::PipelineDescription;
using graph::Problem;

/// Names of the YAML files in folders; of those that are there.
std::vector<std::string> names_in(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, missing))
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  return names;
}

/// "uwa" -> the project's configs/uwa.yaml, unless a file of that name is here. A data set's folder
/// may well be called so.
std::string find_config(const std::string& config) {
  const fs::path own = shared_folder() / "configs" / (config + ".yaml");
  const bool is_name = config.find('/') == std::string::npos;
  const bool is_here = fs::exists(config) && !fs::is_directory(config);
  if (!is_name || is_here) return config;
  if (fs::exists(own)) return own.string();
  const std::string near = graph::did_you_mean(config, names_in({own.parent_path()}));
  throw std::invalid_argument(config + ": no such file" +
                              (near.empty() ? ", and no config is called so" : near));
}

/// Pipelines stand beside the config, in ../pipelines from there, or in the project.
std::string find_pipeline(const std::string& name, const std::string& config) {
  const fs::path folder = fs::path(config).parent_path();
  const std::string file = name + ".yaml";
  const fs::path own = shared_folder() / "pipelines" / file;
  for (const fs::path& path : {folder / file, folder / ".." / "pipelines" / file, own})
    if (fs::exists(path)) return path.lexically_normal().string();
  return "";
}

/// As find_pipeline, but says what is wrong where there is none.
std::string need_pipeline(const std::string& name, const std::string& config) {
  const std::string file = find_pipeline(name, config);
  if (!file.empty()) return file;
  const fs::path folder = fs::path(config).parent_path();
  const std::string near = graph::did_you_mean(
      name, names_in({folder, folder / ".." / "pipelines", shared_folder() / "pipelines"}));
  throw std::invalid_argument(
      "no pipeline is called '" + name + "'" +
      (near.empty() ? ", expected " + name + ".yaml beside the file or in pipelines/" : near));
}

/// What finds the pipeline again from anywhere: its name, or the path of one of the user's own.
std::string lasting_name(const PipelineDescription& pipeline) {
  const fs::path file = pipeline.where.file;
  if (file.empty() || file == find_pipeline(pipeline.name, "/")) return pipeline.name;
  return fs::absolute(file).replace_extension().string();
}

PipelineDescription read_named(const std::string& name, const graph::Location& where,
                               const std::string& config, std::vector<Problem>& problems) {
  std::string file;
  try {
    file = need_pipeline(name, config);
  } catch (const std::invalid_argument& error) {
    problems.push_back({where, "", error.what()});
    return {};
  }
  return graph::read_pipeline(file, problems, need_pipeline);
}

std::vector<std::string> node_names(const PipelineDescription& a, const PipelineDescription& b) {
  std::vector<std::string> names;
  for (const PipelineDescription* pipeline : {&a, &b})
    for (const graph::NodeDescription& node : pipeline->nodes) names.push_back(node.name);
  return names;
}

void apply(PipelineDescription& scenes, PipelineDescription& models,
           const std::vector<Override>& overrides, std::vector<Problem>& problems) {
  const std::vector<Override> left =
      graph::apply_overrides(models, graph::apply_overrides(scenes, overrides));
  if (scenes.nodes.empty() && models.nodes.empty()) return;  // the pipeline could not be read
  for (const Override& change : left) {
    if (change.node.empty()) continue;  // a malformed --set, reported
    problems.push_back({change.setting.where, change.node + "." + change.key,
                        "no such node in the pipeline '" +
                            (scenes.nodes.empty() ? models : scenes).name + "'" +
                            graph::did_you_mean(change.node, node_names(scenes, models))});
  }
}

void emit_parameters(YAML::Emitter& out, const graph::Plan& plan) {
  auto parameters = graph::effective_parameters(plan);
  for (const graph::PlannedNode& node : plan.nodes) {
    const auto& values = parameters[node.name];
    const bool is_renamed = node.spec->name != node.name;
    if (node.like || (values.empty() && !is_renamed)) continue;
    out << YAML::Key << node.name << YAML::Value << YAML::BeginMap;
    if (is_renamed) out << YAML::Key << "node" << YAML::Value << node.spec->name;
    for (const auto& [key, value] : values) out << YAML::Key << key << YAML::Value << value;
    out << YAML::EndMap;
  }
}

/// The pipeline that a config names, or that the file is; a config's values go to `overrides`.
PipelineDescription read_wiring(const std::string& config, const std::string& pipeline,
                                std::vector<Override>& overrides, std::vector<Problem>& problems) {
  const std::string file = find_config(config);
  if (graph::is_pipeline(file)) {
    if (!pipeline.empty())
      throw std::invalid_argument("--pipeline " + pipeline + ": " + file +
                                  " is a pipeline itself, expected a config");
    return graph::read_pipeline(file, problems, need_pipeline);
  }
  graph::ConfigDescription description = graph::read_config(file, problems);
  if (!pipeline.empty()) {
    description.pipeline = pipeline;
    description.where = {"--pipeline", 0, 0};
  }
  overrides.insert(overrides.end(), description.overrides.begin(), description.overrides.end());
  if (description.pipeline.empty()) return {};
  PipelineDescription wiring = read_named(description.pipeline, description.where, file, problems);
  wiring.plugins.insert(wiring.plugins.end(), description.plugins.begin(),
                        description.plugins.end());
  return wiring;
}

void load_plugins(const PipelineDescription& pipeline, std::vector<Problem>& problems) {
  for (const graph::Wire& plugin : pipeline.plugins) try {
      graph::load_plugin(graph::file_of(plugin));
    } catch (const std::invalid_argument& error) {
      problems.push_back({plugin.where, "plugins", error.what()});
    }
}

void plan(const PipelineDescription& scenes, const PipelineDescription& models,
          Configuration& configuration, std::vector<Problem>& problems) {
  if (!models.nodes.empty())
    configuration.models = graph::make_pipeline<ModelLibrary(ModelFiles)>(
        models, "a pipeline for models", {}, problems);
  if (!scenes.nodes.empty())
    configuration.scenes = graph::make_pipeline<Detections(SceneFile)>(
        scenes, "a pipeline for scans",
        {{models.result.stream, graph::StreamTraits<ModelLibrary>::type()}}, problems);
}

}  // namespace

Configuration load_configuration(const std::string& config, const std::vector<std::string>& sets,
                                 const std::vector<Override>& defaults, const std::string& pipeline,
                                 const std::vector<Override>& options) {
  std::vector<Problem> problems;
  Configuration result;
  std::vector<Override> overrides = defaults;
  PipelineDescription scenes = read_wiring(config, pipeline, overrides, problems);
  for (const std::string& set : sets) overrides.push_back(graph::read_set(set, problems));
  overrides.insert(overrides.end(), options.begin(), options.end());
  result.name = fs::path(find_config(config)).stem().string();
  result.pipeline = lasting_name(scenes);
  result.wiring = scenes;

  PipelineDescription models;
  if (scenes.models.empty())
    std::swap(scenes, models);
  else
    models = read_named(scenes.models, scenes.models_where, scenes.models_where.file, problems);
  for (const PipelineDescription* each : {&scenes, &models}) load_plugins(*each, problems);
  apply(scenes, models, overrides, problems);
  graph::resolve_likes(models, nullptr, problems);
  graph::resolve_likes(scenes, &models, problems);
  plan(scenes, models, result, problems);
  if (!problems.empty()) throw graph::ConfigError(std::move(problems));
  return result;
}

graph::Constants constants_of(const Configuration& configuration,
                              const std::shared_ptr<const ModelLibrary>& library,
                              graph::Activity* activity) {
  const graph::Plan& models = configuration.models;
  return graph::fold_constants(
      configuration.scenes,
      {{models.streams[std::size_t(models.result)].name, graph::constant(library)}}, activity);
}

std::string effective_yaml(const Configuration& configuration) {
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "pipeline" << YAML::Value << configuration.pipeline;
  if (const auto plugins = graph::loaded_plugins(); !plugins.empty()) {
    out << YAML::Key << "plugins" << YAML::Value << YAML::BeginSeq;
    for (const fs::path& plugin : plugins) out << plugin.string();
    out << YAML::EndSeq;
  }
  emit_parameters(out, configuration.models);
  emit_parameters(out, configuration.scenes);
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

std::string training_parameters(const graph::Plan& models) {
  std::ostringstream text;
  for (const auto& [node, wires] : graph::wiring(models)) text << node << '=' << wires << '\n';
  for (const auto& [node, values] : graph::effective_parameters(models))
    for (const auto& [key, value] : values) text << node << '.' << key << '=' << value << '\n';
  return text.str();
}

}  // namespace posevote
