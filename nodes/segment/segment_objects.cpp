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
// that it explains voted for it (poses/score.hpp). Cost: per object `candidates` glances, 160
// neighbourhood queries and sketches, 20 coarse ICPs and some 10 looks, and again for what is not
// found at first; per instance four ICPs, as many of twins, and one of ten thousand points. A scan
// without votes gives no detections; that is no failure. Points without a normal are never matched.
// Known limit: an object of which one flat side alone is seen scores low.
//
//   segment_objects: {in: [votes, densities, scene_features, scene_cloud, scale], out: detections,
//                     max_instances: 1}
#include "nodes/density/refine_mode.hpp"
#include "nodes/poses/segment_params.hpp"
#include "nodes/segment/vote_search.hpp"

namespace posevote::segment {
namespace {

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

Detections segment_objects(const PerObject<VoteSet>& votes, const PerObject<VoteDensity>& densities,
                           const FeatureSet& scene_features, const Cloud& scene_cloud,
                           const Scale& scale, const poses::SegmentParams& params) {
  poses::check_scan(scene_features, scene_cloud, scale);
  check_votes(votes, densities, static_cast<std::size_t>(scene_features.points.rows()));
  for (const auto& slot : votes.slots) poses::check_model(*slot->model);
  poses::ScanState scan(scene_cloud, scene_features, scale.resolution, params.terms);
  std::vector<LiveVotes> objects;
  for (std::size_t i = 0; i < votes.size(); ++i)
    objects.push_back(all_votes(votes[i], densities[i]));
  std::vector<poses::ObjectSearch> searches;
  for (LiveVotes& object : objects)
    searches.emplace_back(sought_for(object, scan, params),
                          propose_from(object, scan, params.terms));
  return poses::make_detections(
      poses::find_instances(searches, scan), params, [&](const poses::Instance& instance) {
        return make_detection(objects[instance.object], instance.candidate,
                              params.terms.confidence);
      });
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

}  // namespace
}  // namespace posevote::segment
