// SPDX-License-Identifier: BSD-3-Clause
// The search of a scan once more, watched: after each step, which place a pose has among the
// candidates of its object.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nodes/poses/find_instances.hpp"
#include "nodes/segment/vote_search.hpp"
#include "tools/explain/alike.hpp"
#include "tools/explain/taps.hpp"

namespace posevote::explain {

/// After one step.
struct Place {
  std::string step;
  std::size_t place = 0;  ///< of the first candidate near the pose, from 1; 0: none is left
  std::size_t of = 0;     ///< so many candidates
};

/// The candidates of one object after each step, as they came.
struct Step {
  std::string name;
  poses::Candidates candidates;
};

/// Watched searches over one scan.
class SearchWatch {
 public:
  using Prepare = std::function<void(poses::ScanState&)>;

  /// Searches by these parameters as segment_objects does; `only`: that object alone, so that no
  /// other takes its points; `prepare`: what is done to the scan before.
  SearchWatch(const Taps& taps, const poses::SegmentParams& params,
              std::optional<std::size_t> only = std::nullopt, const Prepare& prepare = {});

  const std::vector<Step>& steps(std::size_t object) const { return steps_[object]; }
  const poses::Instances& instances() const { return instances_; }

 private:
  std::vector<std::vector<Step>> steps_;  ///< per object
  poses::Instances instances_;
};

/// The way of a pose through those steps, of the round in which it came farthest; it ends with the
/// first step that has none near it.
std::vector<Place> way_of(const std::vector<Step>& steps, const Alike& pose);

}  // namespace posevote::explain
