// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run_setup.hpp"

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "pipelines/overrides.hpp"
#include "tools/manifest/run_inputs.hpp"
#include "tools/progress/progress.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// Published data sets are in mm; the config and --set may say otherwise.
std::vector<graph::Override> dataset_defaults(const RunCommand& command) {
  if (command.dataset.empty()) return {};
  return {{"load_models", "unit", {"mm", {"--dataset", 0, 0}}},
          {"load_scene", "unit", {"mm", {"--dataset", 0, 0}}}};
}

}  // namespace

Configuration read_configuration(const RunCommand& command,
                                 const std::vector<graph::Override>& over) {
  std::vector<graph::Override> options = model_overrides(command.model_unit);
  for (graph::Override& change : scene_overrides(command.scene_unit, command.sensor_pose))
    options.push_back(std::move(change));
  options.insert(options.end(), over.begin(), over.end());
  return load_configuration(command.config, command.set, dataset_defaults(command),
                            command.pipeline, options);
}

ModelFiles find_models(const RunCommand& command) {
  if (!command.library.empty() && !command.models.empty())
    throw std::invalid_argument("expected --models FILE... or --library FILE, one of them");
  if (!command.library.empty()) return {};
  std::vector<std::string> files = command.models;
  if (files.empty() && !command.dataset.empty())
    files = list_dataset_models(command.dataset, command.split);
  if (files.empty()) throw std::invalid_argument("expected --models FILE... or --library FILE");
  return list_models(files);
}

std::shared_ptr<const ModelLibrary> find_library(const RunCommand& command,
                                                 const Configuration& configuration,
                                                 const ModelFiles& models,
                                                 const std::atomic<bool>& interrupted) {
  if (command.library.empty()) {
    graph::Activity activity(&interrupted);
    const Progress progress(
        {"preparing " + std::to_string(models.size()) + " models", 0, &activity, !command.quiet});
    return cached_library(configuration, models,
                          command.cache.empty() ? default_cache() : fs::path(command.cache),
                          bad_models(command.on_error), &activity);
  }
  auto library = load_trained(command.library, configuration);
  tell_odd_sizes(configuration, *library, {});
  return library;
}

}  // namespace posevote
