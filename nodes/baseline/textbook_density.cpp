// SPDX-License-Identifier: BSD-3-Clause
// Rival of estimate_density: the search as the paper describes it (Buch, Kiforenko, Kraft, ICCV
// 2017, section 3.2): a k-d tree over the votes' translations (nanoflann), a radius search at every
// vote, then the rotation test one by one. The same kernel and the same test of membership, so the
// densities are the same; what differs is the time, minutes for a real scan.
//
//   textbook_density: {in: votes, out: densities}
#include <cmath>
#include <nanoflann.hpp>
#include <numbers>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/vote/pose_index.hpp"

namespace posevote {
namespace {

struct Params {
  double sigma_t = 0.01;
  double sigma_r = 22.5;
};

/// The votes' translations as nanoflann reads them.
struct Translations {
  const VoteSet& votes;

  std::size_t kdtree_get_point_count() const { return votes.tx.size(); }
  float kdtree_get_pt(std::size_t vote, std::size_t axis) const {
    const float value = axis == 0 ? votes.tx[vote] : axis == 1 ? votes.ty[vote] : votes.tz[vote];
    return std::isfinite(value) ? value : 1e9F;  // out of everybody's reach
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Translations>,
                                                 Translations, 3>;

VotePoint point_of(const VoteSet& votes, std::size_t v) {
  return {votes.tx[v], votes.ty[v], votes.tz[v], votes.qw[v],
          votes.qx[v], votes.qy[v], votes.qz[v]};
}

VoteDensity textbook_density(const VoteSet& votes, const Params& params) {
  const Bandwidth bandwidth{static_cast<float>(params.sigma_t),
                            static_cast<float>(params.sigma_r * std::numbers::pi / 180)};
  VoteDensity result;
  result.index = std::make_shared<const PoseIndex>(votes, bandwidth);  // segmentation needs it
  result.density.assign(votes.tx.size(), 0);
  if (votes.tx.empty()) return result;
  const Kernel kernel = make_kernel(bandwidth);
  const Translations translations{votes};
  constexpr std::size_t kLeafSize = 10;
  const Tree tree(3, translations, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
  const nanoflann::SearchParams unsorted(0, 0, false);
  const float reach = 1.0001F * kernel.max_dt2;  // squared; the kernel decides who is in
  graph::parallel_for(votes.tx.size(), 256, [&](std::size_t v) {
    const VotePoint vote = point_of(votes, v);
    if (!is_usable(vote, bandwidth)) return;
    const float center[3] = {vote.tx, vote.ty, vote.tz};
    thread_local std::vector<std::pair<std::uint32_t, float>> near;
    tree.radiusSearch(center, reach, near, unsorted);
    std::uint64_t units = 0;
    for (const auto& [other, squared] : near)
      if (const VotePoint b = point_of(votes, other); is_usable(b, bandwidth))
        units += kernel_units(kernel, vote, b);
    result.density[v] = static_cast<double>(units) / static_cast<double>(kWeightUnits);
  });
  return result;
}

const auto registered =
    graph::register_node("textbook_density", textbook_density,
                         "Rival: the density by a k-d tree over translations.")
        .input("votes")
        .output("densities")
        .param("sigma_t", &Params::sigma_t, "m",
               "Bandwidth in translation; votes farther apart do not count.",
               graph::in_range(1e-5, 10))
        .param("sigma_r", &Params::sigma_r, "deg",
               "Bandwidth in rotation; votes turned farther do not count.", graph::in_range(1, 90));

}  // namespace
}  // namespace posevote
