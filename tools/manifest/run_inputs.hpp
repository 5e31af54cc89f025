// SPDX-License-Identifier: BSD-3-Clause
// What a run has read, found again by its manifest: its config, its models and its scans with their
// cameras.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/manifest/manifest.hpp"

namespace posevote {

class RunInputs {
 public:
  /// Reads OUT/run.json; one that is missing or damaged is told by why_not().
  explicit RunInputs(std::filesystem::path out);

  /// Takes the place of the models that the run recorded.
  void use_models(std::vector<std::string> files);

  const Manifest& manifest() const { return manifest_; }  ///< empty where there is none
  const std::string& why_not() const { return why_not_; }

  /// A path that the run was told, from here.
  std::filesystem::path find(const std::filesystem::path& file) const;

  /// The scan of a frame as the run read it; `file`, `scene_id` and `im_id` where the manifest does
  /// not know the frame.
  SceneFile scene(std::size_t frame, const std::filesystem::path& file, int scene_id,
                  int im_id) const;

  /// By effective.yaml. Throws std::invalid_argument or graph::ConfigError where it cannot be used.
  Configuration configuration() const;

  /// Those of the manifest that came from files.
  ModelFiles model_files() const;
  /// From its file, the run's cache, or trained anew. Throws std::invalid_argument where models or
  /// library are gone.
  std::shared_ptr<const ModelLibrary> library(const Configuration& configuration) const;

 private:
  std::filesystem::path out_;
  Manifest manifest_;
  std::string folder_;  ///< where the run was started
  std::string why_not_;
  std::vector<std::string> models_;  ///< in place of the manifest's; may be empty
};

/// A library that was trained before with a config. Throws std::invalid_argument that says why it
/// cannot be used.
std::shared_ptr<const ModelLibrary> load_trained(const std::string& file,
                                                 const Configuration& configuration);

}  // namespace posevote
