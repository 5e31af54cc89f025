// SPDX-License-Identifier: BSD-3-Clause
// Makes the model library of a run: from the cache where it is there and sound, else by training.
#pragma once

#include <filesystem>
#include <memory>

#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "tools/configuration.hpp"

namespace posevote {

/// Runs the models' plan. Throws std::runtime_error "node: what" if it fails.
std::shared_ptr<const ModelLibrary> train(const Configuration& configuration,
                                          const ModelFiles& models);

/// The library from `folder` if one for exactly these model bytes and parameters, by this build of
/// the program, is there, else trains it and puts it there. A damaged file is trained anew, with a
/// warning; a folder that cannot be written costs a warning.
std::shared_ptr<const ModelLibrary> cached_library(const Configuration& configuration,
                                                   const ModelFiles& models,
                                                   const std::filesystem::path& folder);

/// Where libraries are cached unless --cache says otherwise: $XDG_CACHE_HOME/posevote or
/// ~/.cache/posevote.
std::filesystem::path default_cache();

/// What a trained library must have in common with a config that uses it.
std::string library_key(const Configuration& configuration);

}  // namespace posevote
