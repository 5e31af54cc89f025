// SPDX-License-Identifier: BSD-3-Clause
// From the bytes of images to light and back (IEC 61966-2-1), and to how it looks (CIELAB).
#pragma once

#include <cstdint>

#include "nodes/data/cloud.hpp"

namespace posevote::color {

/// Light in [0, 1] of a byte, by sRGB's gamma.
float linear_of(std::uint8_t value);
/// Of an encoded value in [0, 1]; what is beyond is clamped, NaN is 0.
float linear_of(double encoded);
/// The byte nearest to a light; beyond [0, 1] the nearest end.
std::uint8_t byte_of(float linear);

/// n x 3: L* in [0, 100], a* (green to red) and b* (blue to yellow), of the white of sRGB (D65).
PointMatrix lab_of(const ColorMatrix& colors);

}  // namespace posevote::color
