// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/simulate/sensor.hpp"

namespace posevote {

/// The sensor of a name from sensor_names(), or that a YAML file describes:
///
///   width: 848             # pixels
///   height: 480
///   field: 65              # deg that the image's width sees; or fx, fy, cx, cy [pixels]
///   noise: 0.0005          # deviation of ranges at any distance [m]
///   noise_z2: 0.001        # and what it gains with the square of the distance: 1 mm at 1 m [1/m]
///
/// and the other members of Sensor by their names. Throws std::invalid_argument for a name that is
/// neither, with the one that was meant, and graph::ConfigError for a bad file.
Sensor read_sensor(const std::string& name_or_file);

/// For help: "rgbd          640 x 480, 59 x 46 deg, noise 1.4 mm at 1 m", a line for each of
/// sensor_names().
std::string list_sensors();

}  // namespace posevote
