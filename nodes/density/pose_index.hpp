// SPDX-License-Identifier: BSD-3-Clause
// An exact index over votes in SE(3): translation and rotation together.
//
// Paper, eq. 10: the density of a vote is the sum over all votes with |t - t_i| <= sigma_t and
// d_R <= sigma_R of exp(-d_t^2 / 2 sigma_t^2) exp(-d_R^2 / 2 sigma_R^2). The paper searches the
// translations with a k-d tree and tests the rotations one by one; on a real scan some 80 times
// more votes pass the first test than the second, so this index sorts votes by both. It prunes, it
// never approximates: membership is decided by one float32 predicate (`kernel.hpp`), and every
// weight is a multiple of 2^-22, so sums in double are exact and do not depend on their order.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/data/votes.hpp"
#include "nodes/density/kernel.hpp"

namespace posevote::density {

/// A vote near a pose, and what it adds to the density there.
struct WeightedVote {
  std::uint32_t vote = 0;
  float weight = 0;  ///< in (0, 1]
};

/// Immutable once built; safe to read from many threads.
class PoseIndex {
 public:
  /// A vote that is not a pose (not finite, no unit quaternion) is kept out: its density is 0.
  /// Throws std::invalid_argument for a bandwidth outside (0, inf) m or [0.5, 90] deg.
  PoseIndex(const VoteSet& votes, Bandwidth bandwidth);
  ~PoseIndex();

  Bandwidth bandwidth() const;

  /// The density of every vote, in vote order; parallel.
  std::vector<double> densities() const;

  /// Takes the votes `removed` out of the densities of all others: afterwards `density[v]`, for
  /// every v with alive[v], equals what densities() would give if the removed votes had never been
  /// cast. `alive` must already be false for the removed votes and those of earlier calls;
  /// densities of the removed are set to 0.
  void subtract(const std::vector<std::uint32_t>& removed, const std::vector<char>& alive,
                std::vector<double>& density) const;

  /// The votes in the neighbourhood of any pose, in an order that the votes decide alone. The
  /// pose's translation is where the model's centre lands, as in VoteSet.
  std::vector<WeightedVote> neighbours(const Eigen::Vector3f& center,
                                       const Eigen::Quaternionf& rotation) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace posevote::density
