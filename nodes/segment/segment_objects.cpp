// SPDX-License-Identifier: BSD-3-Clause
// Greedy segmentation of a scan into objects (Buch, Kiforenko, Kraft, ICCV 2017, section 4): each
// time the mode of the vote densities that agrees best with the scan, refined by ICP
// (nodes/poses), and the scan points it explains taken out before the next is sought. The
// paper takes the objects in descending number of correspondences; here the best fit goes first, of
// whatever object (poses/find_instances.hpp), so that no wrong object is left with a right one's
// points. Correspondences that start at explained points are taken out of all objects; their votes
// are subtracted from the densities, which equals voting anew without them. The score rests on what
// the sensor measured, free space included (poses/measure_fit.cpp), on how exactly the pose lies
// there, as instances found before do (poses/usual_residual.hpp), and on how many of the features
// that it explains voted for it (poses/score.hpp). Cost: per object 4000 peeks, 600 glances, 160
// neighbourhood queries and sketches, 40 coarse ICPs and some 10 looks, and again for what was
// found, until it is found no more; per instance four ICPs, as many of twins, and one of ten
// thousand points. A scan without votes gives no detections; that is no failure. Points without a
// normal are never matched. Known limit: an object of which one flat side alone is seen scores low.
//
// Two nodes: segment_objects for single scans, and segment_new_objects for a stream, in which what
// the frame before answered needs no search (look_again). The latter also hands on to the next frame.
//
//   segment_objects: {in: [votes, densities, scene_features, scene_cloud, scale], out: detections,
//                     max_instances: 1}
//   segment_new_objects: {in: [votes, densities, scene_features, scene_cloud, scale, seen],
//                         out: [detections, sightings]}
#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/density/refine_mode.hpp"
#include "nodes/poses/sightings.hpp"
#include "nodes/segment/vote_search.hpp"

namespace posevote::segment {
namespace {

using ModelVotes = PerObject<VoteSet>;

Detection make_detection(const LiveVotes& object, const poses::Candidate& candidate,
                         const poses::ConfidenceTerms& terms) {
  const Model& model = *object.votes->model;
  Detection detection = poses::make_detection(model, candidate, terms);
  detection.density = density::raw_density(*object.raw, candidate.proposed);
  detection.runner_up_density =
      density::runner_up_density(*object.votes, object.raw->density, candidate.proposed.center,
                                 poses::kRunnerUpRadius * model.diagonal);
  return detection;
}

/// Of an instance that needed no search.
Detection make_detection(const ModelVotes& objects, const poses::Sighting& seen,
                         const poses::ConfidenceTerms& terms) {
  Detection detection = poses::make_detection(*objects[seen.object].model, seen.candidate, terms);
  detection.density = seen.density;
  detection.runner_up_density = seen.runner_up_density;
  return detection;
}

/// Takes what is known already out of the scan, and closes its places.
void accept(const std::vector<poses::Sighting>& known, std::vector<poses::ObjectSearch>& searches,
            poses::ScanState& scan) {
  for (const poses::Sighting& one : known) {
    poses::ObjectSearch& search = searches[one.object];
    search.accept(one.candidate);
    scan.take_out(search.model(), one.candidate.T_scene_model, search.params().explained_distance);
    scan.learn_from(search.model(), one.candidate);
  }
}

/// What is found beside what is known. `sightings` receives the instances.
Detections segment(const ModelVotes& votes, const PerObject<VoteDensity>& densities,
                   const FeatureSet& scene_features, const Cloud& scene_cloud, const Scale& scale,
                   const poses::SegmentParams& params, std::vector<poses::Sighting>& sightings) {
  poses::check_scan(scene_features, scene_cloud, scale);
  check_votes(votes, densities, static_cast<std::size_t>(scene_features.points.rows()));
  for (const auto& slot : votes.slots) poses::check_model(*slot->model);
  poses::ScanState scan(scene_cloud, scene_features, scale.resolution, params.terms, votes.size());
  std::vector<LiveVotes> objects(votes.size());
  std::vector<std::optional<poses::Sought>> sought(votes.size());
  graph::parallel_for(votes.size(), 1, [&](std::size_t i) {
    objects[i] = all_votes(votes[i], densities[i]);
    sought[i].emplace(sought_for(objects[i], scan, params));
  });
  std::vector<poses::ObjectSearch> searches;
  for (std::size_t i = 0; i < votes.size(); ++i)
    searches.emplace_back(*std::move(sought[i]), propose_from(objects[i], scan, params.terms));
  accept(sightings, searches, scan);
  const poses::Instances instances = poses::find_instances(searches, scan);
  Detections detections =
      poses::make_detections(instances, params, [&](const poses::Instance& instance) {
        return make_detection(objects[instance.object], instance.candidate,
                              params.terms.confidence);
      });
  for (std::size_t i = 0; i < instances.found.size(); ++i)
    sightings.push_back({instances.found[i].object, instances.found[i].candidate,
                         detections.items[i].density, detections.items[i].runner_up_density});
  return detections;
}

Detections segment_objects(const ModelVotes& votes, const PerObject<VoteDensity>& densities,
                           const FeatureSet& scene_features, const Cloud& scene_cloud,
                           const Scale& scale, const poses::SegmentParams& params) {
  std::vector<poses::Sighting> none;
  return segment(votes, densities, scene_features, scene_cloud, scale, params, none);
}

template <class Item, class Confidence>
void sort_by_confidence(std::vector<Item>& items, const Confidence& confidence) {
  std::stable_sort(items.begin(), items.end(),
                   [&](const Item& a, const Item& b) { return confidence(a) > confidence(b); });
}

std::tuple<Detections, poses::Sightings> segment_new_objects(
    const ModelVotes& votes, const PerObject<VoteDensity>& densities,
    const FeatureSet& scene_features, const Cloud& scene_cloud, const Scale& scale,
    const poses::Sightings& seen, const poses::SegmentParams& params) {
  poses::Sightings sightings = seen;
  sightings.params = params;
  Detections detections;
  if (seen.is_searched)
    detections =
        segment(votes, densities, scene_features, scene_cloud, scale, params, sightings.items);
  for (const poses::Sighting& one : seen.items)
    detections.items.push_back(make_detection(votes, one, params.terms.confidence));
  sort_by_confidence(detections.items, [](const Detection& one) { return one.confidence; });
  sort_by_confidence(sightings.items,
                     [](const poses::Sighting& one) { return one.candidate.confidence; });
  return {std::move(detections), std::move(sightings)};
}

const auto registered = poses::with_segment_params(
    graph::register_node("segment_objects", segment_objects,
                         "Finds the instances of all objects one by one, taking what each explains "
                         "out of the scan.")
        .input("votes")
        .input("densities")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("detections"));

const auto registered_for_streams = poses::with_segment_params(
    graph::register_node("segment_new_objects", segment_new_objects,
                         "The same of a stream: beside the instances that look_again saw, finds "
                         "those of the feature points that it left.")
        .input("votes")
        .input("densities")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .input("seen")
        .output("detections")
        .output("sightings"));

}  // namespace
}  // namespace posevote::segment
