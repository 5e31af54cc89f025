// SPDX-License-Identifier: BSD-3-Clause
// Mean shift of a mode on SE(3). The argmax is one of the votes, so it stands on the votes' raster
// (6 deg); the weighted mean of its neighbourhood does not. Translations: weighted mean. Rotations:
// the eigenvector of the largest eigenvalue of sum w q q^T (Markley, Cheng, Crassidis, Oshman,
// "Averaging Quaternions", 2007), which does not mind the quaternions' signs. A shift that would
// lower the density is not taken (the cut kernel does not promise ascent), so the result never is a
// worse mode than the start. Cost: a few neighbourhood queries.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nodes/data/votes.hpp"
#include "nodes/density/find_modes.hpp"

namespace posevote::density {

/// Constants of the method; poses/term_params.cpp says where they come from.
struct ShiftTerms {
  int most_shifts = 10;
};

/// The pose shifted to a place where it is the mean of its neighbourhood; the support stays. Only
/// votes with alive[v] count.
Hypothesis refine_mode(const VoteSet& votes, const VoteDensity& density,
                       const std::vector<char>& alive, const Hypothesis& start,
                       const ShiftTerms& terms = {});

/// Sum of the kernel's weights over all votes, alive or not.
double raw_density(const VoteDensity& density, const Hypothesis& pose);

}  // namespace posevote::density
