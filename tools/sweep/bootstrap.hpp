// SPDX-License-Identifier: BSD-3-Clause
// How sure is a figure over some images? Bootstrap over images (Efron 1979): as many are drawn with
// replacement, two thousand times. All settings are judged on the same draws, so that two of them
// are compared image by image (paired).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tools/evaluate/curve.hpp"

namespace posevote::sweep {

/// 95 %: from the 2.5th to the 97.5th percentile; NaN where there are fewer than two images.
struct Interval {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// What settings are compared by.
using Figure = double (Counts::*)() const;

/// Of one setting.
struct Certainty {
  Interval recall, f1;
  Interval behind;  ///< by how much its figure is below the best one's
};

/// `images`: by setting, then by image, the same images for each. `best`: a setting. The same seed
/// draws the same. O(2000 settings x images).
std::vector<Certainty> bootstrap(const std::vector<std::vector<Counts>>& images, std::size_t best,
                                 Figure figure, std::uint64_t seed);

/// Over all images.
Counts total_of(const std::vector<Counts>& images);

}  // namespace posevote::sweep
