// SPDX-License-Identifier: BSD-3-Clause
// The candidates of one object: which proposals become candidates, which go because a better one
// stands for them, and which places are taken.
//
// Of an object that is hardly seen the right pose has no more support than wrong ones beside it. So
// poses are proposed finely, and what lies near a better one goes when all have been judged.
#pragma once

#include <vector>

#include "nodes/poses/candidate.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

constexpr float kRunnerUpRadius = 0.2F;  // x diagonal; part of what runner_up_density means

/// The places of instances that were found; others of the object keep their distance.
class TakenPlaces {
 public:
  explicit TakenPlaces(float radius_m) : radius_(radius_m) {}
  /// Where it is, and where it was proposed.
  void take(const Model& model, const Candidate& instance);
  bool is_clear(const Eigen::Vector3f& center) const;
  /// Takes out the proposals whose place is not.
  void leave_clear(std::vector<Hypothesis>& proposals) const;
  /// Whether the place of a pose is, and whether it has room beside the instances of all objects.
  bool is_clear(const Sought& sought, const Eigen::Isometry3d& T_scene_model) const;

 private:
  float radius_;
  std::vector<Eigen::Vector3f> centers_;
};

/// The highest support of a proposal whose centre lies elsewhere, 0 where none does; `proposals` in
/// descending order of support.
double support_elsewhere(const std::vector<Hypothesis>& proposals, const Eigen::Vector3f& center,
                         const Model& model);

/// Candidates of those proposals, the best supported first, whose place is clear and that are
/// separate from better ones, as far as they are worth a glance (peek.hpp); sets most_support.
Candidates collect(Sought& sought, std::vector<Hypothesis> proposals, const TakenPlaces& taken);

/// The candidate's pose becomes that of a hypothesis.
void propose_as(const Sought& sought, const Hypothesis& hypothesis, Candidate& candidate);

/// Takes out what a better one stands for, of a sorted pool. What stays speaks for its place: it
/// takes over the highest support, and the pool is sorted again.
void leave_out_likes(const Sought& sought, Candidates& pool);

}  // namespace posevote::poses
