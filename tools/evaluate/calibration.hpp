// SPDX-License-Identifier: BSD-3-Clause
// Can a score be believed? A probability can: of the detections that say 0.8, eight in ten are
// right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/curve.hpp"

namespace posevote {

/// The detections whose score lies in [from, to); the last bin has its end, too.
struct ReliabilityBin {
  double from = 0, to = 0;
  int count = 0;
  double mean_score = 0;  ///< 0 where there is none
  double right = 0;       ///< share of them; 0 where there is none
};

struct Calibration {
  std::vector<ReliabilityBin> bins;  ///< ten of equal width over [0, 1]
  int count = 0;
  /// Expected calibration error (Naeini 2015; Guo 2017): the mean over all detections of
  /// |mean score - share right| in their bin; 0 where there are none.
  double error = 0;
};

/// Empty-handed where a score is no probability: outside of [0, 1].
std::optional<Calibration> calibrate(const std::vector<Verdict>& verdicts);

/// A reliability diagram: share right over mean score, a line for each named calibration beside the
/// diagonal on which it should lie; SVG.
struct NamedCalibration {
  std::string name;
  Calibration calibration;
};
std::string reliability_svg(const std::vector<NamedCalibration>& all);

/// Columns set,from,to,detections,mean_score,right.
std::string reliability_csv(const std::vector<NamedCalibration>& all);

}  // namespace posevote
