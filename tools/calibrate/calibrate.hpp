// SPDX-License-Identifier: BSD-3-Clause
// `posevote calibrate`: the weights by which clues become a confidence (poses/confidence.hpp), from
// poses that a run finds on sets with true poses, right ones and wrong ones.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

namespace posevote {

/// Options of `calibrate`, named as on the command line.
struct CalibrateCommand {
  std::vector<std::string> sets{"calibration", "calibration_more", "calibration_alike"};
  std::string out = "out/calibrate", rule = "add";
  std::vector<std::string> set;
  std::size_t every = 0;
  bool colors = false;
  bool json = false;
};
int calibrate_command(const CalibrateCommand& command, const std::atomic<bool>& interrupted);

}  // namespace posevote
