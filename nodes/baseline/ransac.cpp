// SPDX-License-Identifier: BSD-3-Clause
// RANSAC (Fischler, Bolles 1981), the rival of the paper's sensitivity analysis: the pose of three
// random correspondences, scored by how many correspondences agree with it.
//
// Three correspondences are tried only if the triangles that they span on model and scene have
// sides alike to within `similarity` (Buch et al., ICRA 2013: most wrong samples end here, before a
// pose is fitted). A correspondence agrees where its model point lands within `inlier_distance` of
// its scene point. Each iteration has a random stream of its own, made from the seed, the object
// and the iteration, so threads change nothing. Poses with fewer than three inliers beyond the
// sample are dropped; the `most` best are kept. O(iterations x correspondences) at worst.
//
//   ransac: {in: [correspondences, scene_features, scale], out: hypotheses, iterations: 10000}
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/hypotheses.hpp"
#include "nodes/data/splitmix64.hpp"

namespace posevote::baseline {
namespace {

struct Params {
  int iterations = 10000;
  double inlier_distance = 5;
  double similarity = 0.9;
  int most = 1000;
};

constexpr int kSample = 3;

/// Ends of all correspondences, a column each [m].
struct Pairs {
  Eigen::Matrix3Xf model, scene;
};

Pairs pairs_of(const Correspondences& matches, const FeatureSet& scene) {
  const auto count = static_cast<Eigen::Index>(matches.scene_feature.size());
  Pairs pairs{Eigen::Matrix3Xf(3, count), Eigen::Matrix3Xf(3, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    pairs.model.col(i) = matches.model->features.points.row(matches.model_feature[k]);
    pairs.scene.col(i) = scene.points.row(matches.scene_feature[k]);
  }
  return pairs;
}

using Sample = std::array<Eigen::Index, kSample>;

Sample draw(std::uint64_t random, Eigen::Index count) {
  Sample sample{};
  for (Eigen::Index& i : sample) {
    random = splitmix64(random);
    i = static_cast<Eigen::Index>(random % static_cast<std::uint64_t>(count));
  }
  return sample;
}

/// Whether the sample's triangles have sides alike, and sides at all.
bool is_rigid(const Pairs& pairs, const Sample& sample, float similarity) {
  for (int k = 0; k < kSample; ++k) {
    const Eigen::Index i = sample[std::size_t(k)], j = sample[std::size_t((k + 1) % kSample)];
    const float model = (pairs.model.col(i) - pairs.model.col(j)).norm();
    const float scene = (pairs.scene.col(i) - pairs.scene.col(j)).norm();
    if (!(std::min(model, scene) > similarity * std::max(model, scene))) return false;
  }
  return true;
}

Eigen::Isometry3d fit(const Pairs& pairs, const Sample& sample) {
  Eigen::Matrix3d model, scene;
  for (int k = 0; k < kSample; ++k) {
    model.col(k) = pairs.model.col(sample[std::size_t(k)]).cast<double>();
    scene.col(k) = pairs.scene.col(sample[std::size_t(k)]).cast<double>();
  }
  return Eigen::Isometry3d(Eigen::umeyama(model, scene, false));
}

double count_inliers(const Pairs& pairs, const Eigen::Isometry3d& pose, float distance) {
  const Eigen::Matrix3f R = pose.linear().cast<float>();
  const Eigen::Vector3f t = pose.translation().cast<float>();
  const float squared = distance * distance;
  int count = 0;
  for (Eigen::Index i = 0; i < pairs.model.cols(); ++i)
    count += (R * pairs.model.col(i) + t - pairs.scene.col(i)).squaredNorm() <= squared;
  return count;
}

Hypotheses ransac(const Correspondences& matches, const FeatureSet& scene, const Scale& scale,
                  const graph::FrameContext& frame, const Params& params) {
  Hypotheses found{matches.model, {}};
  if (matches.scene_feature.size() < kSample) return found;
  const Pairs pairs = pairs_of(matches, scene);
  const auto distance = static_cast<float>(params.inlier_distance) * scale.resolution;
  const auto similarity = static_cast<float>(params.similarity);
  const std::uint64_t stream =
      splitmix64(splitmix64(frame.seed) ^ static_cast<std::uint64_t>(matches.model->obj_id));
  std::vector<Hypothesis> tried(static_cast<std::size_t>(params.iterations));
  graph::parallel_for(tried.size(), 64, [&](std::size_t i) {
    const Sample sample = draw(splitmix64(stream ^ i), pairs.model.cols());
    if (!is_rigid(pairs, sample, similarity)) return;
    const Eigen::Isometry3d pose = fit(pairs, sample);
    if (!pose.matrix().allFinite()) return;
    tried[i] = hypothesis_of(pose, matches.model->center, count_inliers(pairs, pose, distance));
  });
  std::erase_if(tried, [](const Hypothesis& one) { return one.support < 2 * kSample; });
  sort_by_support(tried);
  tried.resize(std::min(tried.size(), static_cast<std::size_t>(params.most)));
  found.items = std::move(tried);
  return found;
}

const auto registered =
    graph::register_node("ransac", ransac,
                         "Rival: poses of three random correspondences, scored by the others.")
        .input("correspondences")
        .input("scene_features")
        .input("scale")
        .output("hypotheses")
        .param("iterations", &Params::iterations, "", "Samples of three.",
               graph::in_range(1, 100000000))
        .param("inlier_distance", &Params::inlier_distance, "x resolution",
               "A correspondence this near to its place agrees.", graph::greater_than(0))
        .param("similarity", &Params::similarity, "",
               "Sides of the sampled triangles differ by no smaller a ratio.",
               graph::in_range(0, 1))
        .param("most", &Params::most, "", "Hypotheses to keep.", graph::at_least(1));

}  // namespace
}  // namespace posevote::baseline
