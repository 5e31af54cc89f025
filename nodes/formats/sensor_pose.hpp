// SPDX-License-Identifier: BSD-3-Clause
// Where a sensor stood in its scan's frame, as users say it: in a file beside the scan, in a config
// or on the command line.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string_view>
#include <vector>

namespace posevote::formats {

/// The numbers of a text. Blanks, commas, semicolons and brackets stand between them; `#` begins a
/// comment, which ends with the line. Throws std::runtime_error that says in which line there is
/// something else.
std::vector<double> read_pose_numbers(std::string_view text);

/// T_scan_sensor, which maps the sensor's points into the scan's frame, in the unit of the numbers.
/// 3 numbers: x y z. 7: x y z qx qy qz qw. 16: the matrix row by row. Throws std::runtime_error
/// where there is another number of them, one is not finite, or they hold no rotation.
Eigen::Isometry3d sensor_pose(const std::vector<double>& numbers);

/// The file in which a scan's sensor pose may stand: NAME.pose beside NAME.ply.
std::filesystem::path pose_file_of(const std::filesystem::path& scan);

}  // namespace posevote::formats
