// SPDX-License-Identifier: BSD-3-Clause
// Estimates at every pose vote how densely the votes lie around it: the correct poses of many
// correspondences agree, the wrong ones scatter over all six dimensions of SE(3).
//
// Buch, Kiforenko, Kraft, ICCV 2017, section 3.2, eq. 10: a Gaussian kernel over translation and
// one over rotation (geodesic distance), both cut at their bandwidth. That of rotation is the
// paper's; its 10 mm of translation are what objects of 170 mm have here, others in proportion: of a
// screw all votes lie within 10 mm. Exact; the search is described in pose_index.hpp.
// Cost grows with the number of votes times the number of votes around each.
//
// Fails only for votes of no model, whose bandwidth cannot be derived. A vote that is not finite
// counts nowhere and gets density 0. No votes, no densities.
//
//   estimate_density: {in: votes, out: densities, fraction: 0.06, sigma_r: 22.5}
#include "nodes/density/density_params.hpp"
#include "nodes/density/pose_index.hpp"

namespace posevote::vote {
namespace {

VoteDensity estimate_density(const VoteSet& votes, const density::DensityParams& params) {
  VoteDensity result;
  result.index = std::make_shared<const density::PoseIndex>(votes, params.bandwidth_of(votes));
  result.density = result.index->densities();
  return result;
}

const auto registered = density::with_density_params(
    graph::register_node("estimate_density", estimate_density,
                         "The kernel density of the pose votes in SE(3), at every vote.")
        .input("votes")
        .output("densities"));

}  // namespace
}  // namespace posevote::vote
