// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/color_beside.hpp"

namespace posevote::layouts {

namespace fs = std::filesystem;

fs::path color_beside(const fs::path& depth_image) {
  const fs::path scene = depth_image.parent_path().parent_path();
  for (const char* folder : {"rgb", "color", "gray"})
    for (const char* ending : {".png", ".jpg", ".jpeg"}) {
      fs::path image = scene / folder / depth_image.filename();
      if (fs::exists(image.replace_extension(ending))) return image;
    }
  return {};
}

}  // namespace posevote::layouts
