// SPDX-License-Identifier: BSD-3-Clause
// Why an object of a scan was found or not: which stage lost it, with figures.
//
//   const explain::Run run = explain::open_run("out/today");
//   for (const auto& object : explain::explain(run, "000003_000007", {}).objects)
//     for (const std::string& sentence : object.sentences) ...
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/explain/standing.hpp"
#include "tools/explain/verdict.hpp"

namespace posevote::explain {

struct Request {
  std::string object;                                   ///< name or obj_id; empty: all
  std::map<int, std::vector<Eigen::Isometry3d>> truth;  ///< true poses by obj_id; may be empty
  bool attempt = false;       ///< runs what depends on a setting again, to see what helps
  bool is_of_misses = false;  ///< leaves out what was found, and what has no true pose
};

/// One instance, or one object that is not found, of a scan.
struct Explained {
  std::string model;
  int obj_id = 0;
  bool is_found = false;
  bool is_one_more = false;      ///< perhaps, beside those that are found or named before it
  std::optional<Standing> best;  ///< the found pose, or the best candidate
  std::optional<Standing> truth;
  bool best_is_true = false;  ///< whether the two are near each other
  Verdict verdict;            ///< by the true pose where there is one
  Verdict guess;              ///< without it
  std::vector<std::string> sentences;
  std::vector<Attempt> attempts;
};

struct Explanation {
  FrameOfRun frame;
  std::shared_ptr<const Taps> taps;    ///< what flowed between the stages; null of a failed scan
  std::vector<std::string> sentences;  ///< of the scan as a whole
  std::vector<Explained> objects;      ///< by obj_id, the found before the missed
};

/// One scan of a run, which it runs once more. What comes out refers to `run`. Throws
/// std::invalid_argument for a scan or an object that is not in the run.
Explanation explain(const Run& run, const std::string& scene, const Request& request = {});

}  // namespace posevote::explain
