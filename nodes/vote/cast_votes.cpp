// SPDX-License-Identifier: BSD-3-Clause
// Casts N_r pose votes for every correspondence: two oriented points that match leave one degree of
// freedom, the turn about the normal, and the votes lie on that circle.
//
// Buch, Kiforenko, Kraft, ICCV 2017, section 3.1. Given the model's centre c, a model point p with
// normal n and its match p', n' in the scene:
//
//   delta = (p - c).n      r = c - (p - delta n)      q = p' - delta n'     (1)-(3)
//   r'_k  = |r| (u cos a_k + (n' x u) sin a_k)        t_k = q + r'_k        (4), (5)
//   F     = [r/|r|, n x r/|r|, n]                                           (6)
//   F'_k  = [r'_k/|r|, n' x r'_k/|r|, n']                                   (7)
//   R_k   = F'_k F^T
//
// The paper prints R = F'^T F, which does not carry n to n'. t_k is where the *centre* lands. Where
// the normal passes through the centre (|r| = 0: spheres, ends of cylinders) all t_k coincide, any
// direction orthogonal to n serves as r/|r|, and the turns still differ. The paper starts each
// circle at random; here the start is a hash of the seed, the object and the correspondence's
// number in the scan, so that a scan votes alike wherever it stands in a batch.
//
// Linear in the votes. A correspondence whose points or normals are not usable (not finite, zero
// normal) casts none; no correspondences, no votes. Throws where an index points outside its
// features.
//
//   cast_votes: {in: [correspondences, scene_features], out: votes, rotations: 60}
#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/splitmix64.hpp"
#include "nodes/data/votes.hpp"

namespace posevote::vote {
namespace {

struct Params {
  int rotations = 60;
};

struct OrientedPoint {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< unit; not finite where the input is not usable

  bool usable() const { return point.allFinite() && normal.allFinite(); }
};

OrientedPoint oriented_point(const FeatureSet& features, std::uint32_t i) {
  const Eigen::Vector3d normal = features.normals.row(i).transpose().cast<double>();
  return {features.points.row(i).transpose().cast<double>(), normal / normal.norm()};
}

/// Where the circle of a correspondence starts, in [0, 2 pi).
double start_angle(std::uint64_t seed, int obj_id, std::size_t correspondence) {
  const std::uint64_t object = splitmix64(seed) ^ static_cast<std::uint64_t>(obj_id);
  const std::uint64_t hash = splitmix64(splitmix64(object) ^ correspondence);
  return 2 * std::numbers::pi * std::ldexp(static_cast<double>(hash >> 11U), -53);
}

/// `q`: x, y, z, w, as Eigen has them.
void set_vote(VoteSet& votes, std::size_t v, const Eigen::Vector3d& t, const Eigen::Vector4d& q) {
  votes.tx[v] = static_cast<float>(t.x());
  votes.ty[v] = static_cast<float>(t.y());
  votes.tz[v] = static_cast<float>(t.z());
  votes.qw[v] = static_cast<float>(q.w());
  votes.qx[v] = static_cast<float>(q.x());
  votes.qy[v] = static_cast<float>(q.y());
  votes.qz[v] = static_cast<float>(q.z());
}

/// cos and sin of half of each turn from a circle's start.
using HalfTurns = std::vector<std::complex<double>>;

HalfTurns half_turns(std::uint32_t count) {
  HalfTurns turns;
  for (std::uint32_t k = 0; k < count; ++k)
    turns.push_back(std::polar(1.0, std::numbers::pi * k / count));
  return turns;
}

/// The circle of one correspondence into the slots from `first`. R_k is R_0 turned about n' by a_k,
/// so its quaternion is a product and needs no matrix per vote.
void cast_circle(const OrientedPoint& model, const Eigen::Vector3d& center,
                 const OrientedPoint& scene, double start, const HalfTurns& turns,
                 std::size_t first, VoteSet& votes) {
  const Eigen::Vector3d& n = model.normal;
  const Eigen::Vector3d& n_scene = scene.normal;
  const double delta = (model.point - center).dot(n);            // eq. 1
  const Eigen::Vector3d r = center - (model.point - delta * n);  // eq. 2
  const Eigen::Vector3d q = scene.point - delta * n_scene;       // eq. 3
  const double radius = r.norm();
  // Below a nanometre r is what rounding left over, not a direction.
  const bool degenerate = radius < 1e-9;
  const Eigen::Vector3d e = degenerate ? n.unitOrthogonal() : Eigen::Vector3d(r / radius);
  const Eigen::Vector3d u = n_scene.unitOrthogonal();
  const Eigen::Vector3d v = n_scene.cross(u);
  Eigen::Matrix3d model_frame, scene_frame;
  model_frame << e, n.cross(e), n;  // eq. 6
  scene_frame << u, v, n_scene;     // eq. 7 at a = 0
  const Eigen::Quaterniond at_zero =
      Eigen::Quaterniond(Eigen::Matrix3d(scene_frame * model_frame.transpose())).normalized();
  // (cos a/2, n' sin a/2) times R_0, whose second part is the same for all.
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(0, n_scene.x(), n_scene.y(), n_scene.z()) * at_zero;
  const std::complex<double> half_start = std::polar(1.0, start / 2);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const std::complex<double> half = half_start * turns[k], whole = half * half;
    const Eigen::Vector3d t = q + radius * (u * whole.real() + v * whole.imag());  // eq. 4, 5
    set_vote(votes, first + k, t, half.real() * at_zero.coeffs() + half.imag() * turned.coeffs());
  }
}

/// Numbers of the correspondences that can vote.
std::vector<std::uint32_t> usable_correspondences(const Correspondences& matches,
                                                  const FeatureSet& model,
                                                  const FeatureSet& scene) {
  if (matches.model_feature.size() != matches.scene_feature.size())
    throw std::runtime_error("correspondences hold " +
                             std::to_string(matches.scene_feature.size()) + " scene features but " +
                             std::to_string(matches.model_feature.size()) + " model features");
  const auto check = [](std::uint32_t feature, const FeatureSet& features, const char* whose) {
    if (feature >= features.points.rows() || feature >= features.normals.rows())
      throw std::runtime_error("a correspondence names " + std::string(whose) + " feature " +
                               std::to_string(feature) + ", there are " +
                               std::to_string(features.points.rows()));
  };
  std::vector<std::uint32_t> usable;
  for (std::uint32_t i = 0; i < matches.scene_feature.size(); ++i) {
    check(matches.model_feature[i], model, "model");
    check(matches.scene_feature[i], scene, "scene");
    if (oriented_point(model, matches.model_feature[i]).usable() &&
        oriented_point(scene, matches.scene_feature[i]).usable())
      usable.push_back(i);
  }
  return usable;
}

VoteSet cast_votes(const Correspondences& matches, const FeatureSet& scene,
                   const graph::FrameContext& frame, const Params& params) {
  VoteSet votes;
  votes.model = matches.model;
  votes.votes_per_correspondence = static_cast<std::uint32_t>(params.rotations);
  if (matches.scene_feature.empty()) return votes;
  if (!matches.model) throw std::runtime_error("correspondences without a model");
  const Model& model = *matches.model;
  const Eigen::Vector3d center = model.center.cast<double>();
  const auto usable = usable_correspondences(matches, model.features, scene);
  const std::size_t count = usable.size() * votes.votes_per_correspondence;
  for (auto* column : {&votes.tx, &votes.ty, &votes.tz, &votes.qw, &votes.qx, &votes.qy, &votes.qz})
    column->resize(count);
  for (const std::uint32_t i : usable) votes.scene_feature.push_back(matches.scene_feature[i]);
  const HalfTurns turns = half_turns(votes.votes_per_correspondence);
  graph::parallel_for(usable.size(), 64, [&](std::size_t slot) {
    const std::uint32_t i = usable[slot];
    cast_circle(oriented_point(model.features, matches.model_feature[i]), center,
                oriented_point(scene, matches.scene_feature[i]),
                start_angle(frame.seed, model.obj_id, i), turns,
                slot * votes.votes_per_correspondence, votes);
  });
  return votes;
}

const auto registered =
    graph::register_node("cast_votes", cast_votes,
                         "Pose votes: all turns of the model about the normal of each match.")
        .input("correspondences")
        .input("scene_features")
        .output("votes")
        .param("rotations", &Params::rotations, "",
               "Votes per correspondence, N_r: how finely the turn is sampled.",
               graph::in_range(1, 360));

}  // namespace
}  // namespace posevote::vote
