// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "nodes/data/texture.hpp"
#include "tools/simulate/scanner.hpp"

namespace posevote {

/// What a colour camera sees that looks through the sensor's own eye: matt and somewhat glossy
/// surfaces, in ambient light and that of two lamps, whose colours and places differ from image to
/// image, as do the exposure (by a factor of two either way) and the white balance (some 15 %);
/// with the noise of photons and of reading. Bodies without a paint are grey. The same arguments give
/// the same bits at any number of threads.
ColorImage photograph(const std::vector<Body>& bodies, const Sensor& sensor,
                      const Eigen::Isometry3d& T_world_sensor, std::uint64_t seed);

}  // namespace posevote
