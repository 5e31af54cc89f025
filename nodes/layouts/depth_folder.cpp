// SPDX-License-Identifier: BSD-3-Clause
// A folder of depth images (.png, .npy) in depth/ and one camera file for all beside it or in it; in
// the order of their names.
#include "nodes/formats/format.hpp"
#include "nodes/layouts/camera_file.hpp"
#include "nodes/layouts/color_beside.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/recording.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> depth_images(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const fs::path& entry : entries_of(folder))
    if (formats::has_ending(entry, formats::Wanted::kDepthImages)) images.push_back(entry);
  return images;
}

const auto registered = register_recording(
    {"depth images", "depth images in depth/, and camera.json",
     [](const fs::path& folder) {
       return !depth_images(folder / "depth").empty() && camera_beside(folder / "depth/image");
     },
     [](const fs::path& folder) {
       std::vector<SceneFile> files;
       for (const fs::path& image : depth_images(folder / "depth"))
         files.push_back({image, 0, 0, camera_beside(image), {}, {}, color_beside(image)});
       return files;
     }});

}  // namespace
}  // namespace posevote::layouts
