// SPDX-License-Identifier: BSD-3-Clause
// Will it find my part, from how far, how hidden? Scans of somebody's own parts are simulated,
// recognised with the default config and judged, before anything is bought.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/curve.hpp"
#include "tools/simulate/spec.hpp"

namespace posevote::part {

/// Options of `simulate --models`, named as on the command line.
struct Command {
  std::vector<std::string> models;
  std::string model_unit = "auto";
  std::string sensor = "rgbd";            ///< a name or a file (simulate/sensor_file.hpp)
  std::vector<double> ranges{0.5, 1, 2};  ///< from the sensor to the ground's middle [m]
  std::optional<double> noise;  ///< of ranges at any distance, instead of the sensor's [m]
  int scans = 16;               ///< of each range
  double precision = 0.99;      ///< that is wanted of what is believed
  int seed = 1;
  bool quick = false, json = false;
  std::string out;
};

/// A true instance, and whether it was found at a confidence of 0.5.
struct Outcome {
  double range = 0;    ///< [m]
  double visible = 0;  ///< share of its pixels
  bool found = false;
  double score = 0;  ///< confidence of what found it
  int obj_id = 0;
};

/// What came of all scans.
struct Tally {
  std::vector<std::string> parts;  ///< by obj_id - 1
  std::vector<Outcome> outcomes;
  std::vector<Verdict> verdicts;  ///< on all detections
  std::vector<double> ranges;     ///< ascending [m]
  std::vector<int> scans;         ///< of each range
  std::vector<int> wrong;         ///< false detections of each range
};

/// The scans of one range, in four steps from little clutter to much; `diagonal`: of the largest
/// part [m].
Spec make_spec(const Command& command, double range, double diagonal);

/// What is reported; files RECALL.{csv,json,svg} below `out`.
std::string to_text(const Tally& tally, const Command& command);
void write(const Tally& tally, const Command& command);

/// The least confidence from which on at least that share of all detections is right; nothing where
/// none is.
std::optional<double> threshold_for(const std::vector<Verdict>& verdicts, double precision);

/// Up to `range` and down to `visible` 95 % are found, at the edges, too: the largest such part of
/// what was tried; nothing where there is none with ten instances.
struct Reach {
  double range = 0, visible = 0;
  int found = 0, instances = 0;
};
std::optional<Reach> reach_of(const Tally& tally, int obj_id);

/// Makes the scans, runs and judges. Prints a line a range and the table; exit status as `run`.
int check(const Command& command, const std::atomic<bool>& interrupted);

}  // namespace posevote::part
