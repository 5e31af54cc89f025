// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/trials.hpp"

#include <algorithm>

#include "nodes/formats/results_files.hpp"
#include "pipelines/configuration.hpp"
#include "pipelines/library.hpp"

namespace posevote::init {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "first";  ///< of the scan, in names of files

Trial to_trial(const graph::FrameResult<Detections>& result) {
  Trial trial;
  for (const graph::Warning& warning : result.warnings)
    if (warning.node == "load_scene") trial.warnings.push_back(warning.what);
  if (result.failure) {
    trial.failed = result.failure->node + ": " + result.failure->what;
    return trial;
  }
  for (const Detection& item : result.result->items) {
    trial.best = std::max(trial.best, item.confidence);
    if (item.confidence >= kFound) trial.found.push_back(item);
  }
  for (const Detection& item : result.result->rejected)
    trial.best = std::max(trial.best, item.confidence);
  return trial;
}

}  // namespace

Trial Trials::run(const SceneFile& scan, const Settings& settings) {
  SceneFile tried = scan;
  if (tried.camera) tried.camera = settings.camera;  // else it would go before the settings
  return run_with(tried, "default", settings.sets(), "");
}

Trial Trials::run(const SceneFile& scan, const fs::path& config, const fs::path& picture) {
  const fs::path folder = picture.parent_path() / ".first";
  formats::begin_results(folder);  // which the pipeline's writers ask for
  Trial trial = run_with(scan, config.string(), {"write_picture.every=1"}, folder);
  const fs::path made = folder / "pictures" / (std::string(kName) + ".png");
  if (fs::exists(made)) fs::rename(made, picture);
  fs::remove_all(folder);
  return trial;
}

Trial Trials::run_with(const SceneFile& scan, const std::string& config,
                       const std::vector<std::string>& sets, const fs::path& out) {
  ++count_;
  const Configuration configuration = load_configuration(config, sets);
  std::shared_ptr<const ModelLibrary>& library = libraries_[library_key(configuration)];
  if (!library) library = cached_library(configuration, models_, cache_, BadModels::kLeaveOut);
  graph::FrameContext context;
  context.name = kName;
  context.out = out;
  context.file = scan.path;
  return to_trial(graph::run_one(configuration.scenes, constants_of(configuration, library),
                                 graph::Frame<SceneFile>{std::move(context), {scan}}));
}

}  // namespace posevote::init
