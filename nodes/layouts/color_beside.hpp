// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace posevote::layouts {

/// The colour image that belongs to SCENE/depth/NAME.png: SCENE/rgb/NAME, SCENE/color/NAME or, of a
/// camera that sees none, SCENE/gray/NAME, as PNG or JPEG, registered to the depth image. Empty where
/// there is none.
std::filesystem::path color_beside(const std::filesystem::path& depth_image);

}  // namespace posevote::layouts
