// SPDX-License-Identifier: BSD-3-Clause
// Point-pair features (Drost, Ulrich, Navab, Ilic, CVPR 2010; OpenCV's code): a share of the
// scan's points vote, by all pairs that they make, for the pose of the model; poses that agree are
// one.
//
// The clusters are as wide as one step of the sampling and of the angles: what OpenCV's defaults
// mean, which are wrong for any unit but one. OpenCV compares angles of rotation, not rotations, so
// a cluster may mix poses that share their place alone.
//
// Works on the points that the other methods match, but on no correspondences: flat ground, of
// which any two points are like any two of a flat side of an object, would take it hours. OpenCV's
// grid has as many cells along each axis of the bounding box and 160 at most, so a small object in
// a wide scan is sampled more coarsely than it was trained. Quadratic in the sampled points: OpenCV
// pairs points that are farther apart than the object is long, too. A scan that is flat along an
// axis gives nothing.
//
//   opencv_ppf: {in: [ppf_models, scene_features], out: hypotheses}
#include <stdexcept>

#include "graph/registry.hpp"
#include "nodes/adapters/opencv_ppf_detector.hpp"
#include "nodes/data/ppf_model.hpp"

namespace posevote::baseline {
namespace {

Hypotheses opencv_ppf(const PpfModel& object, const FeatureSet& scene,
                      const adapters::PpfMatching& params) {
  if (scene.normals.rows() != scene.points.rows())
    throw std::runtime_error("the scan has points without normals");
  return {object.model, object.detector->match(scene, params, object.model->center)};
}

const auto registered =
    graph::register_node("opencv_ppf", opencv_ppf,
                         "Rival: poses that pairs of scan points vote for (OpenCV).")
        .input("ppf_models")
        .input("scene_features")
        .output("hypotheses")
        .param("reference_share", &adapters::PpfMatching::reference_share, "",
               "Share of the sampled scan points that vote.", graph::in_range(0.01, 1))
        .param("cluster_distance", &adapters::PpfMatching::cluster_distance, "x diagonal",
               "Poses nearer than this are one.", graph::at_least(0))
        .param("cluster_angle", &adapters::PpfMatching::cluster_angle, "deg",
               "If their angles of rotation differ by less.", graph::at_least(0));

}  // namespace
}  // namespace posevote::baseline
