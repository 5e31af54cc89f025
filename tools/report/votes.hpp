// SPDX-License-Identifier: BSD-3-Clause
// The votes of one object in one scan. A run keeps none: it goes through the scan again, up to them.
#pragma once

#include "nodes/data/files.hpp"
#include "nodes/pictures/dense_votes.hpp"
#include "pipelines/configuration.hpp"

namespace posevote::page {

/// At most `most` votes are kept. Throws std::invalid_argument where the pipeline estimates no
/// density or has no such object, and what a node throws.
pictures::DenseVotes votes_of(const Configuration& configuration, const graph::Constants& constants,
                              const SceneFile& scene, int obj_id, std::size_t most);

}  // namespace posevote::page
