// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/standing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "nodes/density/pose_index.hpp"
#include "nodes/density/refine_mode.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/explain_points.hpp"
#include "nodes/poses/refinement.hpp"
#include "nodes/poses/score.hpp"
#include "nodes/poses/separation.hpp"

namespace posevote::explain {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

std::size_t count(const std::vector<char>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), char(1)));
}

std::vector<char> rows_on(const Model& model, const Eigen::Isometry3d& T_scene_model,
                          const PointMatrix& points, const PointMatrix& normals, float distance) {
  const geometry::SurfaceIndex index(model.cloud.points, distance);
  return poses::explain_points(model.cloud, index, T_scene_model, points, normals, distance);
}

Seen look(const poses::Sought& sought, const Eigen::Isometry3d& T_scene_model) {
  const poses::Fit fit = poses::measure(sought, T_scene_model, poses::kAllPoints);
  Seen seen;
  seen.supported = share(fit.supported, fit.facing);
  seen.contradicted = share(fit.contradicted, fit.facing);
  seen.mismatched = share(fit.mismatched, fit.facing);
  seen.unmeasured = share(fit.unseen, fit.facing);
  seen.outside = share(fit.outside, fit.facing);
  seen.hidden = share(fit.hidden - fit.outside, fit.facing);
  seen.scan_points = count(rows_on(sought.model, T_scene_model, sought.scan.cloud.points,
                                   sought.scan.cloud.normals, sought.params.tolerance));
  return seen;
}

/// By the votes of one of the poses that look alike.
struct Around {
  double density = 0;
  std::size_t agreeing = 0, pairs = 0;
};

Around votes_around(const segment::LiveVotes& object, const Eigen::Isometry3d& T_scene_model) {
  const VoteSet& votes = *object.votes;
  Around around;
  if (!object.raw->index) return around;
  const Hypothesis at = hypothesis_of(T_scene_model, votes.model->center, 0);
  std::set<std::uint32_t> agreeing;
  for (const auto& [vote, weight] : object.raw->index->neighbours(at.center, at.rotation)) {
    around.density += static_cast<double>(weight);
    if (vote < votes.circle_votes())
      agreeing.insert(vote / votes.votes_per_correspondence);
    else
      ++around.pairs;
  }
  around.agreeing = agreeing.size();
  return around;
}

}  // namespace

std::vector<std::pair<std::string, double>> Judged::reasons() const {
  std::vector<std::pair<std::string, double>> all;
  for (std::size_t i = 0; i < kClueCount; ++i) all.emplace_back(kClueNames[i], against[i]);
  all.emplace_back("colors", colors_against);
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return all;
}

double Judged::forgiven() const {
  if (confidence <= 0 || confidence >= 1) return confidence;
  // What takes more than this all but proves that the pose is wrong.
  constexpr double kMostForgiven = 8;
  const double worst = std::clamp(reasons().front().second, 0.0, kMostForgiven);
  return poses::probability_of(std::log(confidence / (1 - confidence)) + worst);
}

Judged judged_as(const poses::Candidate& candidate, const poses::Terms& terms) {
  Judged judged;
  judged.confidence = candidate.confidence;
  judged.score = candidate.score();
  judged.clues = candidate.clues;
  judged.against = poses::against(candidate.clues, terms.confidence);
  if (candidate.color_clues)
    judged.colors_against = -poses::log_odds_of(*candidate.color_clues, terms.color);
  return judged;
}

Bench::Bench(const Taps& of, const SearchWatch& watched)
    : taps(of),
      search(watched),
      params(of.run.segmentation()),
      whole(*of.cloud, *of.features, of.scale.resolution, params.terms) {
  for (std::size_t i = 0; i < taps.votes.size(); ++i)
    objects.push_back(segment::all_votes(taps.votes[i], taps.densities[i]));
  for (const poses::Instance& one : search.instances().found)
    explained_.push_back(rows_near(one.object, one.candidate.T_scene_model,
                                   &poses::InstanceParams::explained_distance));
}

void Bench::take_out(const poses::Instance& one, poses::ScanState& scan) const {
  const Model& model = taps.votes[one.object].model->at(scan.resolution);
  scan.take_out(model, one.candidate.T_scene_model,
                poses::instance_params(params, model, scan.resolution).explained_distance);
}

void Bench::take_out_found(poses::ScanState& scan) const {
  for (const poses::Instance& one : search.instances().found) {
    const Model& model = taps.votes[one.object].model->at(scan.resolution);
    take_out(one, scan);
    scan.learn_from(model, one.candidate);
  }
}

/// Doubtful instances took points, too; one near the pose is the pose itself.
void Bench::take_out_doubtful(std::size_t object, const Alike& alike,
                              poses::ScanState& scan) const {
  for (const poses::Instance& one : search.instances().rejected) {
    if (one.object == object && alike.is_near(one.candidate.T_scene_model)) continue;
    if (one.is_chosen) take_out(one, scan);
  }
}

poses::Acquaintance Bench::others_than(std::size_t object, const Alike& alike) const {
  poses::Acquaintance others{taps.votes.size(), {}};
  for (const poses::Instance& one : search.instances().found)
    if (one.object != object || !alike.is_near(one.candidate.T_scene_model))
      others.found.push_back({taps.votes[one.object].model->obj_id, one.candidate.confidence});
  return others;
}

void Bench::count_features(std::size_t object, const poses::Sought& sought,
                           Standing& standing) const {
  const std::vector<char> on = rows_on(sought.model, standing.T_scene_model, taps.features->points,
                                       taps.features->normals, sought.params.tolerance);
  for (const Octave& rows : sought.voters)
    standing.features += static_cast<std::size_t>(
        std::count(on.begin() + rows.begin, on.begin() + rows.end, char(1)));
  for (std::size_t i = 0; i < taps.correspondences.size(); ++i) {
    const Correspondences& matches = taps.correspondences[i];
    const auto matched = static_cast<std::size_t>(
        std::count_if(matches.scene_feature.begin(), matches.scene_feature.end(),
                      [&](std::uint32_t row) { return on[row] != 0; }));
    if (i == object) {
      standing.matched = matched;
    } else if (matched > standing.matched_other) {
      standing.matched_other = matched;
      standing.other = matches.model->name;
    }
  }
}

void Bench::count_votes(std::size_t object, const Alike& alike, Standing& standing) const {
  const segment::LiveVotes& votes = objects[object];
  for (const Eigen::Isometry3d& pose : alike.poses()) {
    const Around around = votes_around(votes, pose);
    if (around.density < standing.density) continue;
    standing.density = around.density;
    standing.agreeing = around.agreeing;
    standing.pairs = around.pairs;
  }
  const std::vector<Hypothesis> modes = segment::modes_of(votes);
  if (!modes.empty()) standing.highest = modes.front().support;
  const auto near = std::find_if(modes.begin(), modes.end(),
                                 [&](const Hypothesis& mode) { return alike.is_near(mode); });
  if (near != modes.end()) standing.density = std::max(standing.density, near->support);
}

Judged Bench::judge(std::size_t object, const Alike& alike, const poses::ScanState& scan,
                    const Standing& standing, Eigen::Isometry3d& T_refined) const {
  poses::Sought sought = segment::sought_for(objects[object], scan, params);
  sought.most_support = std::max(standing.highest, poses::kSomeSupport);
  poses::Candidate candidate;
  poses::propose_as(sought,
                    hypothesis_of(standing.T_scene_model, sought.model.center, standing.density),
                    candidate);
  candidate.elsewhere = poses::support_elsewhere(segment::modes_of(objects[object]),
                                                 candidate.proposed.center, sought.model);
  poses::refine(sought, candidate);
  poses::polish(sought, candidate);
  T_refined = candidate.T_scene_model;
  const poses::Acquaintance others = others_than(object, alike);
  poses::doubt_as_stranger(others, params.terms, candidate);
  if (!(candidate.quality > 0)) return judged_as(candidate, params.terms);
  poses::believe_in_company({{sought.model.obj_id, params.terms, candidate}}, others);
  Judged judged = judged_as(candidate, params.terms);
  const poses::FitShares shares = poses::shares_of(candidate.fit, params.terms.fit);
  judged.agreement = shares.agreement;
  judged.relief = candidate.fit.relief;
  judged.outline = shares.outline;
  judged.rmse = candidate.fit.rmse;
  judged.votes_per_feature = poses::votes_per_feature(sought, candidate);
  return judged;
}

std::vector<char> Bench::rows_near(std::size_t object, const Eigen::Isometry3d& T_scene_model,
                                   float poses::InstanceParams::*distance) const {
  const Model& model = taps.votes[object].model->at(whole.resolution);
  return rows_on(model, T_scene_model, taps.cloud->points, taps.cloud->normals,
                 poses::instance_params(params, model, whole.resolution).*distance);
}

void Bench::compare_found(std::size_t object, const Alike& alike, Standing& standing) const {
  const std::vector<char> on =
      rows_near(object, standing.T_scene_model, &poses::InstanceParams::tolerance);
  std::vector<char> gone(on.size(), 0);
  std::size_t most = 0;
  for (std::size_t k = 0; k < explained_.size(); ++k) {
    const poses::Instance& one = search.instances().found[k];
    if (one.object == object) {
      const double off = alike.distance(one.candidate.T_scene_model);
      if (off < standing.near_same.value_or(std::numeric_limits<double>::infinity())) {
        standing.near_same = off;
        standing.T_near_same = one.candidate.T_scene_model;
      }
      if (alike.is_near(one.candidate.T_scene_model)) continue;
    }
    std::size_t took = 0;
    for (std::size_t i = 0; i < on.size(); ++i) {
      if (!on[i] || !explained_[k][i]) continue;
      ++took;
      gone[i] = 1;
    }
    if (took <= most) continue;
    most = took;
    standing.taker = taps.votes[one.object].model->name;
  }
  standing.taken = share(count(gone), count(on));
}

Standing Bench::stand(std::size_t object, const Eigen::Isometry3d& T_scene_model) const {
  const poses::Sought sought = segment::sought_for(objects[object], whole, params);
  const Alike alike(*objects[object].votes->model, T_scene_model);
  Standing standing;
  standing.T_scene_model = T_scene_model;
  standing.range = whole.range_of(sought.model, T_scene_model);
  standing.seen = look(sought, T_scene_model);
  count_features(object, sought, standing);
  count_votes(object, alike, standing);
  standing.way = way_of(search.steps(object), alike);
  if (!standing.way.empty()) {
    standing.rank = standing.way.front().place;
    standing.peaks = standing.way.front().of;
  }
  standing.judged = judge(object, alike, whole, standing, standing.T_refined);
  poses::ScanState left(*taps.cloud, *taps.features, taps.scale.resolution, params.terms);
  take_out_found(left);
  take_out_doubtful(object, alike, left);
  Eigen::Isometry3d T_left;
  standing.left = judge(object, alike, left, standing, T_left);
  standing.inside = left.share_inside(sought.model, T_left);
  standing.moved = alike.distance(standing.T_refined);
  standing.turned = alike.turn(standing.T_refined);
  standing.stayed = alike.is_near(standing.T_refined);
  compare_found(object, alike, standing);
  return standing;
}

}  // namespace posevote::explain
