// SPDX-License-Identifier: BSD-3-Clause
// What a run has left in its folder, as far as it can be read.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "graph/trace.hpp"
#include "nodes/data/model.hpp"

namespace posevote {

using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// What is missing, or is no number, is NaN; text is empty.
struct ReportedObject {
  std::string model;
  int obj_id = 0;
  double confidence = 0, score = 0, density = 0, runner_up_density = 0, inlier_fraction = 0,
         rmse = 0;
  std::vector<double> T_scene_model;  ///< 16 finite numbers row by row [m], or none
  NamedNumbers clues, against;
  std::string why;  ///< of a rejected one
  double pose_confidence = 0;
  std::vector<std::pair<Eigen::Matrix4d, double>> look_alikes{};  ///< motions and probabilities
};

struct AnsweredFrame {
  double number = 0;
  std::string file;
  std::string name;  ///< UTF-8
  int scene_id = 0, im_id = 0;
  double seconds = 0, latency = 0;  ///< [s]
  std::vector<ReportedObject> found, rejected;
  std::vector<std::string> warnings;  ///< "node: what"
  NamedNumbers stages;                ///< seconds by node
};

struct FailedFrame {
  double number = 0;
  std::string file, node, what;
};

struct RunResults {
  std::vector<AnsweredFrame> frames;
  std::vector<FailedFrame> failures;
  std::vector<LeftOutModel> left_out;    ///< models that could not be used
  std::vector<graph::NodeTimes> stages;  ///< over the answered frames, slowest first
  std::size_t torn = 0;                  ///< lines that are none, of a run that was killed
};

/// Whether there is one to read.
bool holds_run(const std::filesystem::path& folder);
/// What cannot be read is left out.
RunResults read_run(const std::filesystem::path& folder);

}  // namespace posevote
