// SPDX-License-Identifier: BSD-3-Clause
#include "tools/library.hpp"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <stdexcept>

#include "graph/runner.hpp"
#include "nodes/library/library_file.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// What it was trained by: the same models and parameters give another library after a change of
/// the nodes.
constexpr const char* kThisProgram = "/proc/self/exe";

/// The parameters, and obj_id and name of each model: bytes alone do not say which object it is.
std::string parameters_with_names(const Configuration& configuration, const ModelFiles& models) {
  std::string text = training_parameters(configuration.models);
  for (const ModelFile& model : models)
    text += std::to_string(model.obj_id) + " " + model.name + "\n";
  return text;
}

/// The graph numbers the objects of a node that runs once for each; whoever reads it wants the
/// file.
std::string message(const graph::Failure& failure, const ModelFiles& models) {
  if (!failure.object || *failure.object >= models.size())
    return failure.node + ": " + failure.what;
  return failure.node + ": " + models[*failure.object].path.string() + ": " + failure.cause;
}

}  // namespace

std::shared_ptr<const ModelLibrary> train(const Configuration& configuration,
                                          const ModelFiles& models) {
  const auto result = graph::run_one(configuration.models, {}, {{}, {models}});
  if (result.failure) throw std::runtime_error(message(*result.failure, models));
  return result.result;
}

std::shared_ptr<const ModelLibrary> cached_library(const Configuration& configuration,
                                                   const ModelFiles& models,
                                                   const fs::path& folder) {
  std::vector<fs::path> files{kThisProgram};
  for (const ModelFile& model : models) files.push_back(model.path);
  const std::string key = library::hash_files(files, parameters_with_names(configuration, models));
  const fs::path file = folder / (key + ".library");
  if (fs::exists(file)) {
    std::string why_not;
    if (auto library = library::load_library(file, key, why_not))
      return std::make_shared<const ModelLibrary>(std::move(*library));
    spdlog::warn("{}: {}; the library is trained anew", file.string(), why_not);
  }
  auto library = train(configuration, models);
  try {
    fs::create_directories(folder);
    library::save_library(*library, file, key);
  } catch (const std::exception& error) {
    spdlog::warn("the library is not cached: {}", error.what());
  }
  return library;
}

fs::path default_cache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return fs::path(cache) / "posevote";
  if (const char* home = std::getenv("HOME"); home && *home)
    return fs::path(home) / ".cache" / "posevote";
  return fs::temp_directory_path() / "posevote-cache";
}

std::string library_key(const Configuration& configuration) {
  return library::hash_files({}, training_parameters(configuration.models));
}

}  // namespace posevote
