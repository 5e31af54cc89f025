// SPDX-License-Identifier: BSD-3-Clause
// Makes the model library of a run: from the cache where it is there and sound, else by training.
#pragma once

#include <filesystem>
#include <memory>

#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "pipelines/configuration.hpp"

namespace posevote {

/// What to do about a model that cannot be read or trained.
enum class BadModels { kStop, kLeaveOut };

/// "stop" or "skip", as the command line has it.
inline BadModels bad_models(const std::string& on_error) {
  return on_error == "stop" ? BadModels::kStop : BadModels::kLeaveOut;
}

/// Runs the models' plan. Without the models that are left out the library is as if they had not
/// been asked for, but for their names: training begins anew. Says on standard error what the nodes
/// warn of. Throws std::runtime_error "node:
/// what" if it fails, or no model is left, and graph::Cancelled by `activity`.
std::shared_ptr<const ModelLibrary> train(const Configuration& configuration,
                                          const ModelFiles& models,
                                          BadModels bad = BadModels::kStop,
                                          graph::Activity* activity = nullptr);

/// Names on standard error the models of a library trained before whose sizes say that their unit is
/// another; training says so itself. `files`: theirs, or none.
void tell_odd_sizes(const Configuration& configuration, const ModelLibrary& library,
                    const ModelFiles& files);

/// Names on standard error the models that are left out.
void tell_left_out(const ModelLibrary& library);

/// The library from `folder` if one for exactly these model bytes and parameters, by this build of
/// the program, is there, else trains it and puts it there. A damaged file is trained anew, with a
/// warning; a folder that cannot be written costs a warning. Where one is put there, those that nobody
/// has used for 30 days are taken away.
std::shared_ptr<const ModelLibrary> cached_library(const Configuration& configuration,
                                                   const ModelFiles& models,
                                                   const std::filesystem::path& folder,
                                                   BadModels bad = BadModels::kStop,
                                                   graph::Activity* activity = nullptr);

/// Of a model's file, name, number and given symmetries, or of its mesh: what tells it from another.
/// Throws std::runtime_error naming a file that cannot be read.
std::string hash_model(const ModelFile& model);

/// Where libraries are cached unless --cache says otherwise: $XDG_CACHE_HOME/posevote or
/// ~/.cache/posevote.
std::filesystem::path default_cache();

/// What a trained library must have in common with a config that uses it.
std::string library_key(const Configuration& configuration);

}  // namespace posevote
