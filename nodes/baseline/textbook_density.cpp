// SPDX-License-Identifier: BSD-3-Clause
// Rival of estimate_density: the search as the paper describes it (Buch, Kiforenko, Kraft, ICCV
// 2017, section 3.2): a k-d tree over the votes' translations (nanoflann), a radius search at every
// vote, then the rotation test one by one. The same kernel and the same test of membership, so the
// densities are the same; what differs is the time, minutes for a real scan.
//
//   textbook_density: {in: votes, out: densities}
#include <nanoflann.hpp>

#include "graph/parallel.hpp"
#include "nodes/density/density_params.hpp"
#include "nodes/density/pose_index.hpp"
#include "nodes/density/sorted_votes.hpp"

namespace posevote::baseline {
namespace {

/// The votes one by one, as nanoflann reads their translations; those that are no pose left out.
struct UsableVotes {
  std::vector<density::VotePoint> points;
  std::vector<std::size_t> votes;  ///< of the set, per point

  UsableVotes(const VoteSet& set, density::Bandwidth bandwidth) {
    for (std::size_t v = 0; v < set.tx.size(); ++v) {
      const density::VotePoint point = density::vote_point(set, v);
      if (!density::is_usable(point, bandwidth)) continue;
      points.push_back(point);
      votes.push_back(v);
    }
  }
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? points[i].tx : axis == 1 ? points[i].ty : points[i].tz;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, UsableVotes>,
                                                 UsableVotes, 3>;

VoteDensity textbook_density(const VoteSet& votes, const density::DensityParams& params) {
  const density::Bandwidth bandwidth = params.bandwidth_of(votes);
  VoteDensity result;
  result.index =
      std::make_shared<const density::PoseIndex>(votes, bandwidth);  // segmentation needs it
  result.density.assign(votes.tx.size(), 0);
  const UsableVotes usable(votes, bandwidth);
  if (usable.points.empty()) return result;
  const density::Kernel kernel = density::make_kernel(bandwidth);
  constexpr std::size_t kLeafSize = 10;
  const Tree tree(3, usable, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
  const nanoflann::SearchParams unsorted(0, 0, false);
  const float reach = 1.0001F * kernel.max_dt2;  // squared; the kernel decides who is in
  graph::parallel_for(usable.points.size(), 256, [&](std::size_t i) {
    const density::VotePoint& vote = usable.points[i];
    const float center[3] = {vote.tx, vote.ty, vote.tz};
    thread_local std::vector<std::pair<std::uint32_t, float>> near;
    tree.radiusSearch(center, reach, near, unsorted);
    std::uint64_t units = 0;
    for (const auto& [other, squared] : near)
      units += density::kernel_units(kernel, vote, usable.points[other]);
    result.density[usable.votes[i]] = density::density_of(units);
  });
  return result;
}

const auto registered = density::with_density_params(
    graph::register_node("textbook_density", textbook_density,
                         "Rival: the density by a k-d tree over translations.")
        .input("votes")
        .output("densities"));

}  // namespace
}  // namespace posevote::baseline
