// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/confidence.hpp"

#include <algorithm>
#include <cmath>

#include "nodes/poses/company.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {
namespace {

/// Of true poses, so that it says nothing.
constexpr double kUsualVotesPerFeature = 0.3;

/// Log of a lead that chance does not give.
constexpr double kClearLead = 1;

/// What has that share in the ground cannot be there.
constexpr double kAllSunk = 0.5;

/// Medians of 700 right detections of simulated scans of parts, household objects and bins.
constexpr Clues kUsualClues{3.3, -0.9, -1.5, 0, -0.7, -0.3, 0, 8.3, -3.2, 0, -0.2, 0, 0, 0, 0};

/// Looks into holes that nobody took: few of them say little.
constexpr double kFewLooks = 5;

/// Log odds of its holes being filled.
double filled_odds(const Fit& fit) {
  const double filled = static_cast<double>(fit.filled_holes) * fit.stands_for;
  const double open = static_cast<double>(fit.holes) * fit.stands_for - filled;
  return std::log((filled + kFewLooks) / (open + kFewLooks));
}

/// Its support over that of the best proposal elsewhere.
double lead_of(const Candidate& candidate) {
  return candidate.proposed.support / std::max(candidate.elsewhere, kSomeSupport);
}

/// Beyond these bounds more is neither better nor worse.
double bounded_log(double value, double low, double high) {
  return std::log(std::clamp(value, low, high));
}

}  // namespace

Clues clues_of(const Fit& fit, const Backing& backing, const FitTerms& terms) {
  const FitShares shares = shares_of(fit, terms);
  Clues clues{};
  clues[kAgreement] = bounded_log(shares.agreement / (1.02 - shares.agreement), 0.1, 50);
  clues[kRelief] = bounded_log(fit.relief, 0.01, 0.7);
  clues[kOutline] = bounded_log(3 * shares.outline + 0.02, 0.02, 1.5);
  clues[kVotes] = bounded_log(backing.votes_per_feature.value_or(kUsualVotesPerFeature), 0.002, 3);
  clues[kLead] = bounded_log(backing.lead, 0.1, 10);
  clues[kExactness] = bounded_log(backing.exactness, 0.1, 1);
  // Of a large thing much is supported, wherever it is put.
  clues[kSupport] = bounded_log(static_cast<double>(fit.supported) * fit.stands_for, 30, 5000);
  // Of few points a surface that goes on may be noise, of many it is not: a bracket in the corner
  // of a bin.
  clues[kOverhang] = (1 - shares.continuity) * clues[kSupport];
  clues[kGaps] = bounded_log(shares.gaps + 0.01, 0.01, 0.5);
  clues[kFilled] = filled_odds(fit);
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, fit.facing));
  };
  // A small piece of a thing may tell it, but not one that is flat.
  clues[kVisible] = -clues[kRelief] * bounded_log(share(fit.facing - fit.hidden), 0.02, 1);
  clues[kSunk] = std::min(backing.sunk, kAllSunk);
  // What is hidden takes a body before it; beside the image whatever does not fit is out of sight, so
  // that many places fit. A lead over the others says that this is none of many.
  clues[kOutside] = share(fit.outside) * std::max(0.0, kClearLead - clues[kLead]);
  return clues;
}

double log_odds_of(const Clues& clues, const ConfidenceTerms& terms) {
  double log_odds = terms.offset;
  for (std::size_t i = 0; i < kClueCount; ++i) log_odds += terms.weights[i] * clues[i];
  return log_odds;
}

double first_log_odds(const Candidate& candidate, const Terms& terms) {
  if (candidate.fit.supported == 0) return 0;
  const Clues clues = clues_of(candidate.fit, {1, std::nullopt, lead_of(candidate)}, terms.fit);
  double log_odds = 0;
  for (const Clue clue :
       {kAgreement, kRelief, kOutline, kOverhang, kLead, kSupport, kVisible, kOutside})
    log_odds += terms.confidence.weights[clue] * (clues[clue] - kUsualClues[clue]);
  return log_odds;
}

// A mixture: at times colours are those of another moment, light or print, and say nothing.
double log_odds_of(const ColorClues& clues, const ColorTerms& terms) {
  const double told =
      terms.offset + terms.weights.likeness * clues.likeness + terms.weights.tint * clues.tint;
  return std::log((1 - terms.doubt) * std::exp(told) + terms.doubt);
}

double probability_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

double log_odds_of(double probability) {
  constexpr double kLeastDoubt = 1e-4;  // no confidence is so exact that it tells apart less
  const double p = std::clamp(probability, kLeastDoubt, 1 - kLeastDoubt);
  return std::log(p / (1 - p));
}

Clues against(const Clues& clues, const ConfidenceTerms& terms) {
  Clues missing{};
  for (std::size_t i = 0; i < kClueCount; ++i)
    missing[i] = terms.weights[i] * (kUsualClues[i] - clues[i]);
  return missing;
}

double confidence_of(const Candidate& candidate, const Terms& terms) {
  double log_odds = log_odds_of(candidate.clues, terms.confidence) + candidate.of_twin;
  if (candidate.color_clues) log_odds += log_odds_of(*candidate.color_clues, terms.color);
  return probability_of(log_odds);
}

void doubt_as_stranger(const Acquaintance& known, const Terms& terms, Candidate& candidate) {
  if (!(candidate.quality > 0)) return;
  const double things = static_cast<double>(known.kinds) +
                        terms.confidence.each_found * static_cast<double>(known.found.size());
  candidate.clues[kStrangers] =
      known.kinds == 0 ? 0 : std::min(0.0, std::log(things / terms.confidence.kinds));
  candidate.confidence = confidence_of(candidate, terms);
}

void believe_in_company(const std::vector<Member>& instances, const Acquaintance& others) {
  if (others.kinds == 0) return;
  std::vector<Companion> all = others.found;
  for (const Member& one : instances) all.push_back({one.obj_id, one.candidate.confidence});
  const std::vector<double> log_odds = log_odds_in_company(all, others.kinds);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    Candidate& candidate = instances[i].candidate;
    candidate.clues[kCompany] = log_odds[others.found.size() + i];
    candidate.confidence = confidence_of(candidate, instances[i].terms);
  }
}

void believe(const Sought& sought, Candidate& candidate) {
  candidate.confidence = 0;
  if (!(candidate.quality > 0)) return;
  Backing backing{exactness(sought, candidate), std::nullopt, lead_of(candidate)};
  backing.sunk =
      sought.scan.ground.share_inside(sought.model, candidate.T_scene_model, sought.scan.view);
  if (sought.votes_per_correspondence > 0) {
    backing.votes_per_feature = votes_per_feature(sought, candidate);
    candidate.consensus = consensus(*backing.votes_per_feature, sought.terms.score);
  }
  candidate.clues = clues_of(candidate.fit, backing, sought.terms.fit);
  if (candidate.colors)
    candidate.color_clues =
        color_clues_of(*candidate.colors, sought.scan.usual_tint.tint(), sought.terms.color);
  candidate.confidence = confidence_of(candidate, sought.terms);
}

}  // namespace posevote::poses
