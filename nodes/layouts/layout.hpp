// SPDX-License-Identifier: BSD-3-Clause
// Data sets as they are published. A layout is one file of this folder, which registers itself with
// one expression; nothing else names it: bop.cpp, sixd.cpp, uwa.cpp. `run --dataset` and `evaluate`
// see a set through the same layout.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/layouts/ground_truth.hpp"

namespace posevote::layouts {

/// The functions but `recognises` throw std::runtime_error naming a file that is missing, malformed
/// or contradicts another.
struct Layout {
  std::string name;
  std::string expected;  ///< the files that make the layout
  std::function<bool(const std::filesystem::path& dataset, const std::string& split)> recognises;
  std::function<std::vector<SceneFile>(const std::filesystem::path& dataset,
                                       const std::string& split)>
      scenes;
  std::function<std::vector<std::filesystem::path>(const std::filesystem::path& dataset)> models;
  /// Poses and images; objects without their points, which read_ground_truth adds.
  std::function<GroundTruth(const std::filesystem::path& dataset, const std::string& split)> truth;
};

/// Throws std::logic_error where another layout has that name. The value means nothing: it lets a
/// file register as it is initialised.
bool register_layout(const Layout& layout);

/// The layout of a folder: of those that recognise it, the first by name. Throws std::runtime_error
/// where none does.
const Layout& find_layout(const std::filesystem::path& dataset, const std::string& split);

}  // namespace posevote::layouts
