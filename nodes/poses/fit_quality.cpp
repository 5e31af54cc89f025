// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "nodes/poses/measure_fit.hpp"

namespace posevote::poses {

// quality = agreement x evidence x continuity.
//
// Agreement is the share of supporters among the points that take a side, as large as they look.
// Points that are hidden, beside the image, or missed at a grazing angle take none, so a true pose
// of which a tenth is visible still agrees. A point that the sensor saw through speaks fully
// against the pose; one that met another surface or no measurement counts half, because noise,
// clutter in contact and drop-outs do that to true poses too.
//
// Agreement alone would let a body sunk into a table grade high: its cap is supported, the rest is
// hidden. Evidence is therefore what the support could only show by fitting: the supported share of
// what faces the sensor, times what there is to go by: the relief of the scan there, and how much
// of the model's outline is met by the scan's (all that shows the pose of a flat side). Measured on
// bin-picking scans, false poses on flat ground reach inliers 0.16 x relief 0.015, true poses
// 0.35..0.7 x 0.3..0.5; on a laser scan 0.4..0.75 x 0.3..0.5 where false ones stay below 0.15 x
// 0.3.
//
// Continuity is the share of the outline beyond which the scan does not go on. All factors are
// ratios, so that the quality does not depend on the object's size or the sampling.
double fit_quality(const Fit& fit, const FitTerms& terms) {
  if (fit.supported == 0) return 0;
  const FitShares shares = shares_of(fit, terms);
  const double clues = fit.relief + terms.outline_weight * shares.outline;
  const double evidence = 1 - std::exp(-fit.inlier_fraction * clues / terms.convincing);
  return shares.agreement * evidence * shares.continuity;
}

FitShares shares_of(const Fit& fit, const FitTerms& terms) {
  const auto supported = static_cast<double>(fit.supported);
  const double looks = geometry::kOutlineDirections * supported;
  const auto ends = static_cast<double>(fit.ends), overhang = static_cast<double>(fit.overhang);
  const auto gaps = static_cast<double>(fit.gaps), filled = static_cast<double>(fit.filled);
  const double few = terms.few_ends * looks;
  const double agreeing = fit.apparent.supported;
  return {agreeing / (agreeing + fit.apparent.against(terms)), (ends - overhang) / looks,
          1 - overhang / (ends + few), (gaps - filled) / looks};
}

}  // namespace posevote::poses
