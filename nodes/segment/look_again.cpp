// SPDX-License-Identifier: BSD-3-Clause
// In a stream, looks whether the instances of the frame before are still there, before anything is
// described. One that is costs a look: ICP from where it was, and the judgement of any other, by the
// rules that segment_new_objects handed on with it; the surest first, each taking out of the scan
// what it explains. Where there were some and all are still there, nothing else is sought but in every
// `search_every`th frame, if any object may have more instances: no feature point is left to
// describe, so that the nodes that follow have nothing to do. Else the feature points that no
// instance explains are left.
//
// What its poses differ by from frame to frame, as noise does, is averaged (poses/steady.hpp).
//
// An object that comes into view so is found up to `search_every` - 1 frames later. Between two
// frames an instance may move by half of icp_distance, or ICP loses it; it then is sought as any
// other.
//
//   look_again: {in: [scene_clouds, scene_points, scale, library, sightings], out: [seen, points]}
#include <algorithm>
#include <chrono>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "graph/previous.hpp"
#include "nodes/geometry/select_rows.hpp"
#include "nodes/poses/explain_points.hpp"
#include "nodes/poses/look.hpp"
#include "nodes/poses/pose_covariance.hpp"
#include "nodes/poses/sightings.hpp"
#include "nodes/poses/steady.hpp"

namespace posevote::segment {
namespace {

using poses::Sighting;
using poses::Sightings;

struct Params {
  int search_every = 5;
  poses::SteadyTerms steady;
};

/// An instance of the frame before in this one.
struct Look {
  poses::Sought sought;
  Sighting now;
};

std::vector<Look> look_at(const Sightings& before, const ModelLibrary& library,
                          const poses::ScanState& scan) {
  using Clock = std::chrono::steady_clock;
  std::vector<Look> looks;
  for (const Sighting& one : before.items) {
    const Model& model = library.models.at(one.object)->at(scan.resolution);
    poses::Sought sought{.model = model,
                         .scan = scan,
                         .params = poses::instance_params(before.params, model, scan.resolution),
                         .terms = before.params.terms,
                         .model_index = nullptr};  // below, side by side
    looks.push_back({std::move(sought), one});
  }
  graph::parallel_for(looks.size(), 1, [&](std::size_t i) {
    const Clock::time_point begin = Clock::now();
    poses::Sought& sought = looks[i].sought;
    sought.model_index = poses::index_of(sought.model, sought.params.tolerance);
    poses::Candidate& candidate = looks[i].now.candidate;
    candidate = poses::look(sought, candidate);
    candidate.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  });
  return looks;
}

bool is_place_free(const Look& look, const std::vector<Sighting>& others) {
  const Model& model = look.sought.model;
  const auto center = [&model](const Sighting& one) {
    return posed_center(one.candidate.T_scene_model, model.center);
  };
  return std::none_of(others.begin(), others.end(), [&](const Sighting& other) {
    return other.object == look.now.object &&
           (center(other) - center(look.now)).norm() <=
               static_cast<double>(look.sought.params.nms_radius);
  });
}

/// Noise that the frames before can average out. A covariance says more than what the frames of one
/// sensor differ by, by its inflation.
void hold_steady(const Sighting& before, Look& look, const poses::SteadyTerms& terms) {
  poses::Candidate& now = look.now.candidate;
  const double inflation = look.sought.terms.covariance.inflation;
  look.now.spread.reset();
  if (!now.covariance) return;
  const geometry::Matrix6d noise = *now.covariance / inflation;
  look.now.spread = noise;
  const auto& known = before.spread ? before.spread : before.candidate.covariance;
  if (!known) return;
  const poses::UncertainPose held =
      poses::steady({before.candidate.T_scene_model, before.spread ? *known : *known / inflation},
                    {now.T_scene_model, noise}, terms);
  now.T_scene_model = held.T_scene_model;
  look.now.spread = held.covariance;
}

/// Those that are still there, and takes out of the scan what they explain.
std::vector<Sighting> keep(const Sightings& before, std::vector<Look>& looks,
                           poses::ScanState& scan, const poses::SteadyTerms& terms) {
  std::vector<Sighting> kept;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    Look& look = looks[i];
    poses::Candidate& candidate = look.now.candidate;
    poses::judge_again(look.sought, candidate);
    // said when all were chosen, and counts in the confidence that the next line sets
    candidate.clues[kCompany] = before.items[i].candidate.clues[kCompany];
    poses::doubt_as_stranger(scan.known, look.sought.terms, candidate);
    const poses::InstanceParams& rules = look.sought.params;
    if (candidate.confidence < rules.min_confidence || candidate.score() < rules.min_score ||
        !is_place_free(look, kept))
      continue;
    candidate.covariance = poses::pose_covariance(look.sought, candidate.T_scene_model);
    if (i + 1 < looks.size())
      scan.take_out(look.sought.model, candidate.T_scene_model, rules.explained_distance);
    scan.learn_from(look.sought.model, candidate);
    hold_steady(before.items[i], look, terms);
    kept.push_back(look.now);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Sighting& a, const Sighting& b) {
    return a.candidate.confidence > b.candidate.confidence;
  });
  return kept;
}

/// The points that none of the instances explains.
FeaturePoints unexplained(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                          const ModelLibrary& library, const Sightings& seen) {
  const Cloud chosen = geometry::select_rows(cloud, points.indices);
  std::vector<char> explained(points.indices.size(), 0);
  for (const Sighting& one : seen.items) {
    const Model& model = library.models[one.object]->at(scale.resolution);
    const float distance =
        poses::instance_params(seen.params, model, scale.resolution).explained_distance;
    const std::vector<char> by_it =
        poses::explain_points(model.cloud, geometry::SurfaceIndex(model.cloud.points, distance),
                              one.candidate.T_scene_model, chosen.points, chosen.normals, distance);
    for (std::size_t i = 0; i < by_it.size(); ++i)
      explained[i] = static_cast<char>(explained[i] | by_it[i]);
  }
  FeaturePoints left;
  for (std::size_t i = 0; i < explained.size(); ++i)
    if (explained[i] == 0) left.indices.push_back(points.indices[i]);
  return left;
}

/// Of all objects together.
std::size_t most_instances(const ModelLibrary& library, const poses::SegmentParams& params) {
  return library.models.size() * static_cast<std::size_t>(params.max_instances);
}

Sightings see(const Cloud& cloud, const Scale& scale, const ModelLibrary& library,
              const Sightings& before, const Params& params) {
  const FeatureSet none;
  poses::ScanState scan(cloud, none, scale.resolution, before.params.terms, library.models.size());
  std::vector<Look> looks = look_at(before, library, scan);
  Sightings now;
  now.params = before.params;
  now.items = keep(before, looks, scan, params.steady);
  const bool is_due = before.frames_since_search + 1 >= params.search_every;
  now.is_searched = before.items.empty() || now.items.size() < before.items.size() ||
                    (is_due && now.items.size() < most_instances(library, before.params));
  now.frames_since_search = now.is_searched ? 0 : before.frames_since_search + 1;
  return now;
}

std::tuple<Sightings, PerObject<FeaturePoints>> look_again(
    const PerObject<Cloud>& clouds, const PerObject<FeaturePoints>& points, const Scale& scale,
    const ModelLibrary& library, const graph::Previous<Sightings>& before, const Params& params) {
  if (!before.value) return {Sightings(), points};
  Sightings seen = see(*clouds.slots.at(0), scale, library, *before.value, params);
  PerObject<FeaturePoints> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    left.slots.push_back(std::make_shared<const FeaturePoints>(
        seen.is_searched ? unexplained(clouds[i], points[i], scale, library, seen)
                         : FeaturePoints()));
  return {std::move(seen), std::move(left)};
}

const auto registered =
    graph::register_node("look_again", look_again,
                         "Looks whether the instances of the frame before are still there, and "
                         "leaves the feature points that are to be searched.")
        .input("clouds")
        .input("points")
        .input("scale")
        .input("library")
        .input("sightings")
        .output("seen")
        .output("points")
        .param("search_every", &Params::search_every, "frames",
               "Other objects are sought in each so many frames, and wherever one was lost; 1: in "
               "every frame.",
               graph::in_range(1, 10000))
        .param(
            "drift", [](Params& params) -> double& { return params.steady.drift; }, "x covariance",
            "How far an instance that seems to stand still may move from frame to frame; the "
            "less, the steadier is its pose. 1000: as it is measured.",
            graph::greater_than(0))
        .expert_param(
            "still", [](Params& params) -> double& { return params.steady.still; }, "",
            "Chi-square (six degrees of freedom) of a pose against the frames before; "
            "with more it has moved, and they count no more.",
            graph::at_least(0));

}  // namespace
}  // namespace posevote::segment
