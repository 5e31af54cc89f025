// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/library.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "graph/plugin.hpp"
#include "graph/runner.hpp"
#include "nodes/data/texture.hpp"
#include "nodes/formats/paint_files.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/library/content_hash.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/training_lock.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

const std::string kEnding = ".library";

std::string symmetry_text(const ModelFile& model) {
  if (!model.symmetries) return "";
  std::ostringstream text;
  text.precision(9);
  text << model.symmetries->fixed_point.transpose();
  for (const Eigen::Quaternionf& turn : model.symmetries->turns)
    text << " turn " << turn.coeffs().transpose();
  for (const Eigen::Vector3f& axis : model.symmetries->axes) text << " axis " << axis.transpose();
  return text.str();
}

template <class Matrix>
std::string bytes_of(const Matrix& matrix) {
  return {reinterpret_cast<const char*>(matrix.data()),
          static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar)};
}

std::string mesh_bytes(const Mesh& mesh) {
  std::string bytes =
      bytes_of(mesh.points) + bytes_of(mesh.normals) + bytes_of(mesh.faces) + bytes_of(mesh.colors);
  if (!mesh.texture) return bytes;
  bytes += bytes_of(mesh.texture->places);
  for (const std::uint32_t image : mesh.texture->image_of) bytes += std::to_string(image) + " ";
  for (const ColorImage& image : mesh.texture->images)
    bytes.append(image.values.begin(), image.values.end());
  return bytes;
}

/// Its obj_id, name and given symmetries: bytes alone do not say which object it is.
std::string identity_of(const ModelFile& model) {
  const std::string text =
      std::to_string(model.obj_id) + " " + model.name + " " + symmetry_text(model) + "\n";
  return model.mesh ? text + mesh_bytes(*model.mesh) : text;
}

/// All that it is read from.
std::vector<fs::path> files_of(const ModelFile& model) {
  if (model.mesh) return {};
  std::vector<fs::path> files = formats::paint_files(model.path);
  files.insert(files.begin(), model.path);
  return files;
}

/// The cause by the model's number. The graph numbers the objects of a node that runs once for each:
/// behind derive_scale these are the models, octave after octave.
std::map<std::size_t, std::string> causes_of(const graph::Failure& failure, std::size_t models) {
  std::map<std::size_t, std::string> causes;
  for (const graph::ObjectFailure& failed : failure.objects)
    causes.emplace(failed.object % models, failed.cause);
  return causes;
}

/// Whoever reads it wants the file.
std::string message(const graph::Failure& failure, const ModelFiles& models) {
  if (failure.objects.empty()) return failure.node + ": " + failure.what;
  std::string text = failure.node;
  const char* before = ": ";
  for (const auto& [model, cause] : causes_of(failure, models.size())) {
    text += before + models[model].path.string() + ": " + cause;
    before = "; ";
  }
  return text;
}

/// Moves the models that failed from the one list to the other.
void leave_out(const graph::Failure& failure, ModelFiles& models,
               std::vector<LeftOutModel>& left_out) {
  const std::map<std::size_t, std::string> causes = causes_of(failure, models.size());
  ModelFiles kept;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto failed = causes.find(i);
    if (failed == causes.end())
      kept.push_back(models[i]);
    else
      left_out.push_back({models[i].name, models[i].obj_id,
                          models[i].path.string() + ": " + failure.node + ": " + failed->second});
  }
  models = std::move(kept);
}

/// Takes away libraries that nobody has used for a month, as those of former builds, and what killed
/// processes left half written ("KEY.library.1a2b.tmp"). What others have put there stays.
void tidy_cache(const fs::path& folder) {
  constexpr auto kLibraries = std::chrono::days(30), kHalves = std::chrono::days(1);
  constexpr std::size_t kKeyLength = 32;
  const auto now = fs::file_time_type::clock::now();
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (name.find(kEnding) != kKeyLength) continue;
    const bool is_whole = name.ends_with(kEnding);
    if (!is_whole && !name.ends_with(".tmp") && !name.ends_with(".lock")) continue;
    const auto written = fs::last_write_time(entry.path(), none);
    if (!none && now - written > (is_whole ? kLibraries : kHalves)) fs::remove(entry.path(), none);
  }
}

/// What the cache holds under that key; null where that is nothing, or nothing that can be used.
std::shared_ptr<const ModelLibrary> known_library(const Configuration& configuration,
                                                  const ModelFiles& models, const fs::path& file,
                                                  const std::string& key, BadModels bad) {
  if (!fs::exists(file)) return nullptr;
  std::string why_not;
  auto library = library::load_library(file, key, why_not);
  if (!library) spdlog::warn("{}: {}; the library is trained anew", file.string(), why_not);
  if (!library || (bad == BadModels::kStop && !library->left_out.empty())) return nullptr;
  std::error_code read_only;
  fs::last_write_time(file, fs::file_time_type::clock::now(), read_only);  // for tidy_cache
  tell_odd_sizes(configuration, *library, models);
  return std::make_shared<const ModelLibrary>(std::move(*library));
}

std::string all_failed(const std::vector<LeftOutModel>& left_out) {
  std::string text = "no model can be used";
  for (const LeftOutModel& model : left_out) text += "; " + model.why;
  return text;
}

}  // namespace

std::shared_ptr<const ModelLibrary> train(const Configuration& configuration,
                                          const ModelFiles& models, BadModels bad,
                                          graph::Activity* activity) {
  ModelFiles sound = models;
  std::vector<LeftOutModel> left_out;
  std::set<std::string> told;
  for (;;) {
    const auto result = graph::run_one(configuration.models, {}, {{}, {sound}}, activity);
    for (const graph::Warning& warning : result.warnings)
      if (told.insert(warning.what).second) spdlog::warn("{}", warning.what);
    if (!result.failure) {
      if (left_out.empty()) return result.result;
      auto library = std::make_shared<ModelLibrary>(*result.result);
      library->left_out = std::move(left_out);
      return library;
    }
    if (bad == BadModels::kStop || result.failure->objects.empty())
      throw std::runtime_error(message(*result.failure, sound));
    leave_out(*result.failure, sound, left_out);
    if (sound.empty()) throw std::runtime_error(all_failed(left_out));
  }
}

void tell_odd_sizes(const Configuration& configuration, const ModelLibrary& library,
                    const ModelFiles& files) {
  const auto parameters = graph::effective_parameters(configuration.models);
  const auto loading = parameters.find("load_models");
  if (loading == parameters.end() || !loading->second.contains("unit")) return;
  for (const auto& model : library.models) {
    const std::string odd = formats::odd_model_size(model->diagonal, loading->second.at("unit"));
    const auto file = std::find_if(files.begin(), files.end(), [&model](const ModelFile& other) {
      return other.obj_id == model->obj_id;
    });
    if (!odd.empty())
      spdlog::warn("{}: {}", file == files.end() ? "the model " + model->name : file->path.string(),
                   odd);
  }
}

void tell_left_out(const ModelLibrary& library) {
  for (const LeftOutModel& model : library.left_out)
    spdlog::error("the model {} (obj_id {}) is left out: {}", model.name, model.obj_id, model.why);
}

std::shared_ptr<const ModelLibrary> cached_library(const Configuration& configuration,
                                                   const ModelFiles& models, const fs::path& folder,
                                                   BadModels bad, graph::Activity* activity) {
  // The same models and parameters give another library after a change of the nodes.
  std::vector<fs::path> files = graph::code_files();
  std::string text = training_parameters(configuration.models);
  for (const ModelFile& model : models) {
    for (fs::path& file : files_of(model)) files.push_back(std::move(file));
    text += identity_of(model);
  }
  const std::string key = library::hash_files(files, text);
  const fs::path file = folder / (key + kEnding);
  const auto known = [&] { return known_library(configuration, models, file, key, bad); };
  if (auto library = known()) return library;
  const TrainingLock lock(file, activity);
  if (lock.waited())
    if (auto library = known()) return library;
  auto library = train(configuration, models, bad, activity);
  try {
    fs::create_directories(folder);
    library::save_library(*library, file, key);
    tidy_cache(folder);
  } catch (const std::exception& error) {
    spdlog::warn("the library is not cached: {}", error.what());
  }
  return library;
}

std::string hash_model(const ModelFile& model) {
  return library::hash_files(files_of(model), identity_of(model));
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
