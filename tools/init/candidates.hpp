// SPDX-License-Identifier: BSD-3-Clause
// Which settings may be meant: units and depth scales by the sizes that things have, places of the
// sensor by what it could have seen.
#pragma once

#include <vector>

#include "nodes/data/cloud.hpp"
#include "tools/init/look.hpp"
#include "tools/init/settings.hpp"

namespace posevote::init {

/// Pairs of units, of depth images pairs of a unit and a scale, the likeliest first: those under
/// which the models and the scan have sizes that such things have, and of these the ones that the
/// pipeline takes itself. A pair that only makes everything larger or smaller than an earlier one
/// is left out, for it finds the same. `given`: has the camera of a depth image; its scale comes
/// before all others.
std::vector<Settings> likely_settings(const std::vector<ModelLook>& models, const ScanLook& scan,
                                      const Settings& given);

/// Where the sensor can have stood, for points that nobody says it of: from there nearly all of
/// them are seen. At most three places, far apart, in the points' unit; none where all are hidden
/// somewhere. A relief can be seen from before and from behind: only a run tells.
std::vector<Eigen::Vector3d> likely_sensors(const Scan& scan);

}  // namespace posevote::init
