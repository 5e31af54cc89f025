// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/vote/pose_index.hpp"

#include <stdexcept>

#include "graph/parallel.hpp"

namespace posevote {

struct PoseIndex::Data {
  Bandwidth bandwidth;
  Kernel kernel;
  std::vector<VotePoint> votes;
  std::vector<char> usable;
};

PoseIndex::PoseIndex(const VoteSet& votes, Bandwidth bandwidth) {
  auto data = std::make_unique<Data>();
  data->bandwidth = bandwidth;
  data->kernel = make_kernel(bandwidth);
  for (std::size_t v = 0; v < votes.tx.size(); ++v) {
    data->votes.push_back({votes.tx[v], votes.ty[v], votes.tz[v], votes.qw[v], votes.qx[v],
                           votes.qy[v], votes.qz[v]});
    data->usable.push_back(is_usable(data->votes[v], bandwidth));
  }
  data_ = std::move(data);
}

PoseIndex::~PoseIndex() = default;

Bandwidth PoseIndex::bandwidth() const { return data_->bandwidth; }

std::vector<double> PoseIndex::densities() const {
  std::vector<double> density(data_->votes.size());
  subtract({}, std::vector<char>(density.size(), 1), density);
  return density;
}

void PoseIndex::subtract(const std::vector<std::uint32_t>&, const std::vector<char>& alive,
                         std::vector<double>& density) const {
  const Data& d = *data_;
  graph::parallel_for(density.size(), 64, [&](std::size_t v) {
    std::uint64_t units = 0;
    if (alive[v] && d.usable[v])
      for (std::size_t w = 0; w < d.votes.size(); ++w)
        if (alive[w] && d.usable[w]) units += kernel_units(d.kernel, d.votes[v], d.votes[w]);
    density[v] = static_cast<double>(units) / static_cast<double>(kWeightUnits);
  });
}

std::vector<WeightedVote> PoseIndex::neighbours(const Eigen::Vector3f& center,
                                                const Eigen::Quaternionf& rotation) const {
  const VotePoint pose{center.x(),   center.y(),   center.z(),  rotation.w(),
                       rotation.x(), rotation.y(), rotation.z()};
  std::vector<WeightedVote> found;
  for (std::size_t v = 0; v < data_->votes.size(); ++v) {
    const std::uint32_t units =
        data_->usable[v] ? kernel_units(data_->kernel, pose, data_->votes[v]) : 0;
    if (units > 0)
      found.push_back({static_cast<std::uint32_t>(v), static_cast<float>(units) / kWeightUnits});
  }
  return found;
}

}  // namespace posevote
