// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/plot/line_chart.hpp"

namespace posevote {
namespace {

constexpr std::size_t kBins = 10;

}  // namespace

std::optional<Calibration> calibrate(const std::vector<Verdict>& verdicts) {
  Calibration calibration;
  for (std::size_t i = 0; i < kBins; ++i) {
    ReliabilityBin& bin = calibration.bins.emplace_back();
    bin.from = static_cast<double>(i) / kBins, bin.to = static_cast<double>(i + 1) / kBins;
  }
  for (const Verdict& verdict : verdicts) {
    const double probability = verdict.probability.value_or(verdict.score);
    if (!(probability >= 0 && probability <= 1)) return std::nullopt;
    const auto place = static_cast<std::size_t>(probability * kBins);
    ReliabilityBin& bin = calibration.bins[std::min(place, kBins - 1)];
    ++bin.count, ++calibration.count;
    bin.mean_score += probability;
    bin.right += verdict.correct;
  }
  for (ReliabilityBin& bin : calibration.bins) {
    if (bin.count == 0) continue;
    bin.mean_score /= bin.count, bin.right /= bin.count;
    calibration.error += std::abs(bin.mean_score - bin.right) * bin.count / calibration.count;
  }
  return calibration;
}

std::string reliability_svg(const std::vector<NamedCalibration>& all) {
  plot::Chart chart;
  chart.title = "reliability", chart.x_label = "score", chart.y_label = "share right";
  chart.x_range = chart.y_range = {0.0, 1.0};
  for (const NamedCalibration& named : all) {
    plot::Series series{named.name, {}, {}};
    for (const ReliabilityBin& bin : named.calibration.bins)
      if (bin.count > 0) series.x.push_back(bin.mean_score), series.y.push_back(bin.right);
    chart.series.push_back(std::move(series));
  }
  chart.series.push_back({"as it should be", {0, 1}, {0, 1}});
  plot::Chart counts;
  counts.title = "detections", counts.x_label = "score", counts.y_label = "in a bin";
  counts.x_range = {0.0, 1.0};
  for (const NamedCalibration& named : all) {
    plot::Series series{named.name, {}, {}};
    for (const ReliabilityBin& bin : named.calibration.bins)
      series.x.push_back((bin.from + bin.to) / 2), series.y.push_back(bin.count);
    counts.series.push_back(std::move(series));
  }
  return plot::to_svg({chart, counts});
}

std::string reliability_csv(const std::vector<NamedCalibration>& all) {
  std::string text = "set,from,to,detections,mean_score,right\n";
  for (const NamedCalibration& named : all)
    for (const ReliabilityBin& bin : named.calibration.bins) {
      char line[120];
      std::snprintf(line, sizeof line, ",%.1f,%.1f,%d,", bin.from, bin.to, bin.count);
      text += named.name + line;
      if (bin.count > 0) {
        std::snprintf(line, sizeof line, "%.6f,%.6f", bin.mean_score, bin.right);
        text += line;
      } else {
        text += ",";
      }
      text += "\n";
    }
  return text;
}

}  // namespace posevote
