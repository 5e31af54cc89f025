// SPDX-License-Identifier: BSD-3-Clause
// The votes of one object in one scan, and how densely they lie: the first figure of Buch,
// Kiforenko, Kraft (ICCV 2017). A run keeps no votes: it goes through the scan again, up to them.
#pragma once

#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/data/votes.hpp"
#include "pipelines/configuration.hpp"

namespace posevote::page {

struct ShownVotes {
  std::size_t count = 0;  ///< of all
  double largest = 0;     ///< density
  /// Where votes put the model's centre [m]: of all votes, by density, every n-th, the densest too;
  /// in ascending order of density.
  PointMatrix centers;
  std::vector<std::uint8_t> heat;  ///< 255 log(density) / log(largest)
};

/// At most `most` votes are kept. Throws std::invalid_argument where the pipeline estimates no
/// density or has no such object, and what a node throws.
ShownVotes votes_of(const Configuration& configuration, const graph::Constants& constants,
                    const SceneFile& scene, int obj_id, std::size_t most);

}  // namespace posevote::page
