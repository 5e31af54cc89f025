// SPDX-License-Identifier: BSD-3-Clause
// What BOP and SIXD 2017 have in common: `SPLIT/SCENE/depth/IMAGE.png`, one file of poses and one
// of cameras a scene, `models/obj_N.ply` and one file that describes the models. They differ in
// file names and in how the files are written.
#pragma once

#include "nodes/layouts/files.hpp"
#include "nodes/layouts/layout.hpp"
#include "nodes/layouts/recording.hpp"

namespace posevote::layouts {

struct ImageFolders {
  const char *poses, *cameras, *visibility;  ///< files of a scene; visibility may be null
  const char* models_info;
  nlohmann::json (*read)(const std::filesystem::path& file);
};

/// The layout that these names make.
Layout layout_of(const ImageFolders& names, const std::string& name, const std::string& expected);
/// One scene's folder of such a set, by itself.
Recording scene_of(const ImageFolders& names, const std::string& name);

}  // namespace posevote::layouts
