// SPDX-License-Identifier: BSD-3-Clause
#include "tools/manifest/run_inputs.hpp"

#include <stdexcept>
#include <utility>

#include "nodes/formats/format.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/library.hpp"

namespace posevote {

namespace fs = std::filesystem;

RunInputs::RunInputs(fs::path out) : out_(std::move(out)) {
  try {
    auto manifest = read_manifest(out_);
    if (manifest) manifest_ = std::move(*manifest);
    if (!manifest) why_not_ = (out_ / "run.json").string() + ": is not there";
  } catch (const std::runtime_error& error) {
    why_not_ = error.what();
  }
  if (!manifest_.starts.empty()) folder_ = manifest_.starts.back().folder;
}

void RunInputs::use_models(std::vector<std::string> files) { models_ = std::move(files); }

fs::path RunInputs::find(const fs::path& file) const {
  const fs::path there = (fs::path(folder_) / file).lexically_normal();
  const auto is_there = [](const fs::path& path) {
    std::error_code none;
    return fs::exists(formats::file_of(path), none);
  };
  return !is_there(there) && is_there(file) ? file : there;
}

SceneFile RunInputs::scene(std::size_t frame, const fs::path& file, int scene_id, int im_id) const {
  const bool is_known = frame < manifest_.scans.size() &&  // where each stands at its number
                        manifest_.scans[frame].file.path.filename() == file.filename();
  SceneFile scene =
      is_known ? manifest_.scans[frame].file : SceneFile{file, scene_id, im_id, std::nullopt};
  scene.path = find(scene.path);
  if (!scene.color.empty()) scene.color = find(scene.color);
  return scene;
}

Configuration RunInputs::configuration() const {
  const fs::path file = out_ / "effective.yaml";
  std::error_code none;
  if (!fs::is_regular_file(file, none))
    throw std::invalid_argument(file.string() +
                                ": not there; expected the --out folder of a `posevote run`");
  return load_configuration(fs::absolute(file).string(), {});
}

ModelFiles RunInputs::model_files() const {
  if (!models_.empty()) return list_models(models_);
  std::vector<std::string> files;
  for (const SoughtModel& model : manifest_.models)
    if (!model.file.empty()) files.push_back(find(model.file).string());
  return files.empty() ? ModelFiles() : list_models(files);
}

std::shared_ptr<const ModelLibrary> RunInputs::library(const Configuration& configuration) const {
  if (models_.empty() && !manifest_.library.empty())
    return load_trained(find(manifest_.library).string(), configuration);
  const ModelFiles files = model_files();
  if (files.empty())
    throw std::invalid_argument((why_not_.empty() ? out_.string() : why_not_) +
                                ": which models the run looked for is not known; say --models");
  return as_arguments([&] {
    return cached_library(configuration, files,
                          manifest_.cache.empty() ? default_cache() : find(manifest_.cache),
                          BadModels::kLeaveOut);
  });
}

std::shared_ptr<const ModelLibrary> load_trained(const std::string& file,
                                                 const Configuration& configuration) {
  std::string why_not;
  auto library = library::load_library(file, library_key(configuration), why_not);
  if (!library) throw std::invalid_argument(file + ": " + why_not + "; train it with this config");
  return std::make_shared<const ModelLibrary>(std::move(*library));
}

}  // namespace posevote
