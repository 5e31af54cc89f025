// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/contest.hpp"

#include <algorithm>
#include <cmath>

#include "nodes/poses/confidence.hpp"
#include "nodes/poses/explain_points.hpp"

namespace posevote::poses {
namespace {

constexpr double kSame = 0.5;  // of the smaller one's points, from which on both claim the same
/// Of what one explains over what the other does, in the odds. Of 370 contests in simulated and real
/// scans of 8 and 21 models, odds alone decide all but three of those between a right and a wrong
/// pose; from 4 to 8 this mends one of them and decides none wrongly.
constexpr double kTrustInExtent = 6;

bool are_apart(const Claim& a, const Claim& b) {
  const auto center = [](const Claim& claim) {
    return posed_center(claim.candidate.T_scene_model, claim.model.center);
  };
  const float reach = (a.model.diagonal + b.model.diagonal) / 2 + a.tolerance + b.tolerance;
  return (center(a) - center(b)).norm() > static_cast<double>(reach);
}

std::vector<char> explained_by(const Claim& claim, const ScanState& scan) {
  return explain_points(claim.model.cloud, claim.model_index, claim.candidate.T_scene_model,
                        scan.cloud.points, scan.cloud.normals, claim.tolerance);
}

}  // namespace

bool goes_before(const Claim& rival, const Claim& first, const ScanState& scan) {
  if (are_apart(rival, first)) return false;
  const std::vector<char> of_rival = explained_by(rival, scan),
                          of_first = explained_by(first, scan);
  double all_of_rival = 0, all_of_first = 0, shared = 0;
  for (std::size_t i = 0; i < of_rival.size(); ++i) {
    if (scan.surface.is_gone(i)) continue;
    all_of_rival += of_rival[i];
    all_of_first += of_first[i];
    shared += of_rival[i] & of_first[i];
  }
  if (shared == 0 || shared < kSame * std::min(all_of_rival, all_of_first)) return false;
  return kTrustInExtent * std::log(all_of_rival / all_of_first) >
         log_odds_of(first.candidate.confidence) - log_odds_of(rival.candidate.confidence);
}

}  // namespace posevote::poses
