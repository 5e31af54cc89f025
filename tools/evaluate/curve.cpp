// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/curve.hpp"

#include <algorithm>

namespace posevote {

std::vector<CurvePoint> make_curve(std::vector<Verdict> verdicts, int instances) {
  std::stable_sort(verdicts.begin(), verdicts.end(),
                   [](const Verdict& a, const Verdict& b) { return a.score > b.score; });
  std::vector<CurvePoint> curve;
  Counts counts;
  counts.instances = instances;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    ++counts.detections;
    counts.correct += verdicts[i].correct;
    if (i + 1 == verdicts.size() || verdicts[i + 1].score < verdicts[i].score)
      curve.push_back({verdicts[i].score, counts});
  }
  return curve;
}

std::optional<CurvePoint> best_f1(const std::vector<CurvePoint>& curve) {
  std::optional<CurvePoint> best;
  for (const CurvePoint& point : curve)
    if (!best || point.counts.f1() > best->counts.f1()) best = point;
  return best;
}

double average_precision(const std::vector<CurvePoint>& curve) {
  double area = 0, envelope = 0;
  for (std::size_t i = curve.size(); i-- > 0;) {
    envelope = std::max(envelope, curve[i].counts.precision());
    const double before = i > 0 ? curve[i - 1].counts.recall() : 0;
    area += (curve[i].counts.recall() - before) * envelope;
  }
  return area;
}

}  // namespace posevote
