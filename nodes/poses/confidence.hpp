// SPDX-License-Identifier: BSD-3-Clause
// How probable it is that a refined pose is right. A score says how well a pose fits; how much that
// is worth differs between sensors and objects: a small support may be chance, a cap of a body sunk
// into a table agrees without a contradiction, a carton's face says little of its length. The
// confidence weighs what is known by a logistic regression (Platt 1999; Cox 1958), whose weights
// `posevote calibrate` finds on simulated scans of other objects than those that are judged.
#pragma once

#include <optional>
#include <vector>

#include "nodes/data/clues.hpp"
#include "nodes/poses/candidate.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {

/// What speaks for a pose besides its fit.
struct Backing {
  /// How large the residual is says less of the pose than of the sensor, so it is compared with that
  /// of the scan's other instances.
  double exactness = 1;
  /// None where support is not a count of votes (the rivals'), which is taken as what true poses
  /// usually have.
  std::optional<double> votes_per_feature;
  double lead = 1;  ///< its support over that of the best proposal elsewhere
  double sunk = 0;  ///< the share of its surface that lies in the ground
};

/// Of a pose of quality > 0.
Clues clues_of(const Fit& fit, const Backing& backing, const FitTerms& terms = {});

/// offset + weights . clues
double log_odds_of(const Clues& clues, const ConfidenceTerms& terms);

/// What a candidate's log odds are above those of usual right detections, by the clues that are known
/// of every pose: those that only refined ones have, or that take a count, are taken as usual.
double first_log_odds(const Candidate& candidate, const Terms& terms);

/// The same of colours, which is added where there are any.
double log_odds_of(const ColorClues& clues, const ColorTerms& terms);

/// In [0, 1].
double probability_of(double log_odds);

/// Of a probability, by which no two are told apart that are 0.0001 from 0, or from 1, or nearer.
double log_odds_of(double probability);

/// What each clue takes from the log odds, beside what right detections usually have; negative where
/// it speaks for the pose.
Clues against(const Clues& clues, const ConfidenceTerms& terms);

/// Of a candidate's clues, and what it has of the pose that it outdid (twins.hpp).
double confidence_of(const Candidate& candidate, const Terms& terms);

/// Of an instance, once it is chosen: takes from its confidence what speaks for anything's being
/// of a kind that nobody looks for. Before one looks, a thing is of any of `kinds` kinds, each as
/// likely; an instance that was found counts for `each_found` that are known. Who goes first does
/// not depend on it.
void doubt_as_stranger(const Acquaintance& known, const Terms& terms, Candidate& candidate);

/// An instance of an object, of quality > 0.
struct Member {
  int obj_id;
  const Terms& terms;
  Candidate& candidate;
};

/// Of instances, once all are chosen: adds what they, and others, say of each other (company.hpp).
void believe_in_company(const std::vector<Member>& instances, const Acquaintance& others);

/// Sets consensus, clues and confidence of a candidate.
void believe(const Sought& sought, Candidate& candidate);

}  // namespace posevote::poses
