// SPDX-License-Identifier: BSD-3-Clause
// Turns what the command line names (files, folders, globs, a data set) into scenes and models.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"

namespace posevote {

/// What goes wrong before the first frame is wrong with the arguments: nothing ran.
template <class Prepare>
auto as_arguments(const Prepare& prepare) {
  try {
    return prepare();
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

/// One scan of a batch. `number` counts over the whole batch, shards and resumed runs included.
struct SceneEntry {
  std::size_t number = 0;
  std::string name;  ///< unique within the batch, for the files that writers make
  SceneFile file;
};

/// Files, folders (a recording of nodes/layouts, with its cameras; else every file in them that a
/// loader knows) and globs, sorted by path as people count (scan2 before scan10); scene_id 0 and
/// im_id from that order. Throws std::invalid_argument naming an argument that matches nothing.
std::vector<SceneEntry> list_scenes(const std::vector<std::string>& arguments);

/// The scans of a data set in any layout of nodes/layouts; of images, with
/// their cameras. Throws std::invalid_argument naming what is missing.
std::vector<SceneEntry> list_dataset_scenes(const std::string& dataset, const std::string& split);

/// The model files of a data set, for list_models.
std::vector<std::string> list_dataset_models(const std::string& dataset, const std::string& split);

/// Model files in ascending order of obj_id: by the one rule of
/// layouts::number_models. Throws std::invalid_argument for a missing file or two models of one obj_id.
ModelFiles list_models(const std::vector<std::string>& arguments);

/// Keeps entries number = I-1, I-1+N ... of "I/N"; empty text keeps all.
std::vector<SceneEntry> take_shard(std::vector<SceneEntry> scenes, const std::string& shard);

}  // namespace posevote
