// SPDX-License-Identifier: BSD-3-Clause
// What a frame hands to the next of a stream: the instances that it answered with, by which a node
// early in the next looks whether they are still there (nodes/segment/look_again.cpp).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "nodes/poses/segment_params.hpp"

namespace posevote::poses {

/// An instance, with what its search found out about it.
struct Sighting {
  std::size_t object = 0;  ///< number in the library
  Candidate candidate;
  double density = 0, runner_up_density = 0;   ///< of its votes, when it was found by them
  std::optional<geometry::Matrix6d> spread{};  ///< what is left of its covariance after some frames
};

struct Sightings {
  std::vector<Sighting> items;  ///< in descending order of confidence
  bool is_searched = true;      ///< whether other objects are sought in the frame, too
  int frames_since_search = 0;
  SegmentParams params;  ///< by which they were judged, and are to be again
};

}  // namespace posevote::poses
