// SPDX-License-Identifier: BSD-3-Clause
// The grades of a pose (candidate.hpp says what they are called). Whatever proposes poses is graded
// by the same rules.
#pragma once

#include "nodes/poses/candidate.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// How closely a pose is looked at.
struct Closeness {
  Sampling sampling;
  double reach = 1;  ///< how near the points the scan must be [x inlier_distance]
};

/// As closely as can be.
constexpr Closeness kAllPoints{{0, true}};

/// How the scan, as it is now, agrees with a pose.
Fit measure(const Sought& sought, const Eigen::Isometry3d& T_scene_model, const Closeness& look);

/// Adds to the fit what patches of the scan lie off by, from at most about so many points; 0: all.
void measure_residual(const Sought& sought, Candidate& candidate, Eigen::Index points);

/// Sets quality and rank from the fit.
void grade(const Sought& sought, Candidate& candidate);

/// The same, but for what the clues say: of few points, looked at from afar, it is too little.
void grade_at_a_glance(const Sought& sought, Candidate& candidate);

/// Measures the fit, and grades.
void judge(const Sought& sought, Candidate& candidate, const Closeness& look);

/// Whether a refined pose may be an instance: it reaches min_score and is not more than doubtful.
bool is_convincing(const Sought& sought, const Candidate& candidate);

/// In (0, 1], by the instances of all objects that were found before.
double exactness(const Sought& sought, const Candidate& candidate);

/// The support per feature of the scan that the pose explains, as if each had cast usual_votes.
double votes_per_feature(const Sought& sought, const Candidate& candidate);

/// In [0, 1], from votes per feature.
double consensus(double votes_per_feature, const ScoreTerms& terms);

}  // namespace posevote::poses
