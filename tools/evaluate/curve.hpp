// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace posevote {

/// How often one rule was met.
struct Counts {
  double correct = 0;  ///< whole, but for average recalls
  int instances = 0, detections = 0;
  double recall() const { return ratio(correct, instances); }
  double precision() const { return ratio(correct, detections); }
  double f1() const { return ratio(2 * correct, instances + detections); }

 private:
  static double ratio(double part, int whole) { return whole > 0 ? part / whole : 0; }
};

/// A detection that a rule has judged.
struct Verdict {
  double score = 0;
  bool correct = false;
  int line = 0;  ///< of the results file (FoundInstance::line)
  /// Squared Mahalanobis distance of a right one's error; NaN: unknown (PoseMeter::surprise).
  double surprise = std::numeric_limits<double>::quiet_NaN();
  /// That the rule finds it right, as far as the results know; where they do not say, the score.
  std::optional<double> probability{};
};

/// The counts where the detections from `score` up are taken.
struct CurvePoint {
  double score = 0;
  Counts counts;
};

/// One point for each score that occurs, in descending order.
std::vector<CurvePoint> make_curve(std::vector<Verdict> verdicts, int instances);

/// The point of the highest F1, of several the one of the highest score.
std::optional<CurvePoint> best_f1(const std::vector<CurvePoint>& curve);

/// Area under precision over recall, where precision is the best that is reached at that recall or
/// beyond (PASCAL VOC 2010).
double average_precision(const std::vector<CurvePoint>& curve);

}  // namespace posevote
