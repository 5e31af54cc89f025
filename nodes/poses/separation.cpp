// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/separation.hpp"

namespace posevote::poses {
namespace {

/// `better`: numbers of poses.
bool is_suppressed(const Hypothesis& pose, const std::vector<Hypothesis>& poses,
                   const std::vector<std::size_t>& better, const Separation& separation) {
  int here = 0;
  for (const std::size_t i : better) {
    const Hypothesis& other = poses[i];
    if ((pose.center - other.center).norm() > separation.distance) continue;
    if (pose.rotation.angularDistance(other.rotation) <= separation.angle) return true;
    if (++here == separation.per_place) return true;
  }
  return false;
}

}  // namespace

bool is_like(const Hypothesis& a, const Hypothesis& b, const Separation& separation) {
  return (a.center - b.center).norm() <= separation.distance &&
         a.rotation.angularDistance(b.rotation) <= separation.angle;
}

std::vector<std::size_t> separate_poses(const std::vector<Hypothesis>& poses,
                                        const Separation& separation, std::size_t count) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < poses.size() && kept.size() < count; ++i)
    if (!is_suppressed(poses[i], poses, kept, separation)) kept.push_back(i);
  return kept;
}

}  // namespace posevote::poses
