// SPDX-License-Identifier: BSD-3-Clause
// Adds pose votes of pairs of ends of faces: of a flat side that is seen alone, as a carton's or a
// plate's from above, nothing else tells where on it the sensor looks.
//
// As cast_pairs, with ends of faces (nodes/pairs/rims.hpp) in place of points of the surface. Such an
// end has a normal and a direction across it, so that a pair that agrees leaves no turn open, and
// what they say of a face is its outline: the length between two ends and the angles of their
// directions. Drost, Ilic (3DIMPVT 2012) pair points of the surface with those of depth edges; here
// both are ends, since a flat surface has no more to tell.
//
// Where something nearer hides how a face goes on, it does not end. Neither does it at the border of
// the image. Ends need not be feature points, and are added to those that votes come from:
// `vote_points` are the scan's features, without their descriptors, and behind them the ends.
//
// Time: the neighbours of each point of the scan once, and references x pairs of each, some 0.05 ms
// a reference.
//
//   cast_rims: {in: [pair_votes, scene_features, scene_cloud, scale], out: [votes, vote_points]}
#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "graph/registry.hpp"
#include "nodes/geometry/range_view.hpp"
#include "nodes/pairs/cast.hpp"
#include "nodes/pairs/rims.hpp"

namespace posevote::vote {
namespace {

struct Params {
  int references = 500;
  int poses = 8;
  double least_ratio = 0.7;
  double partners = 3;
};

constexpr float kLeastDrop = 2;  // x resolution: nearer than that is not in front

/// Those behind which something nearer, or the border of the image, hides what comes are no ends.
std::vector<pairs::Rim> seen_rims(const Cloud& cloud, float resolution) {
  const float radius = pairs::kRimRadius * resolution;
  std::vector<pairs::Rim> rims = pairs::find_rims(cloud, radius);
  const geometry::RangeView view(cloud, resolution);
  std::erase_if(rims, [&](const pairs::Rim& rim) {
    const Eigen::Vector3f beyond = rim.point + radius * rim.direction;
    if (view.is_outside(beyond)) return true;
    const float measured = view.measured_range(beyond);
    return measured > 0 && measured < (beyond - cloud.view.origin).norm() - kLeastDrop * resolution;
  });
  return rims;
}

/// The ends of a scan's faces, as fine as the models of like size need them.
struct RimScene {
  std::vector<pairs::Reference> references;
  std::unique_ptr<const pairs::PairScene> partners;
};

/// A row for each end that votes may start from.
void append(FeatureSet& points, const std::vector<pairs::Rim>& rims) {
  const Eigen::Index before = points.points.rows();
  const Eigen::Index all = before + std::ssize(rims);
  points.points.conservativeResize(all, 3);
  points.normals.conservativeResize(all, 3);
  for (Eigen::Index i = before; i < all; ++i) {
    const pairs::Rim& rim = rims[static_cast<std::size_t>(i - before)];
    points.points.row(i) = rim.point.transpose();
    points.normals.row(i) = rim.normal.transpose();
  }
}

/// At most `most`, evenly taken.
std::vector<pairs::Rim> pick(const std::vector<pairs::Rim>& rims, std::size_t most) {
  std::vector<pairs::Rim> picked;
  const std::size_t count = std::min(rims.size(), most);
  for (std::size_t i = 0; i < count; ++i) picked.push_back(rims[i * rims.size() / count]);
  return picked;
}

RimScene make_scene(const std::vector<pairs::Rim>& rims, float edge, const Params& params,
                    FeatureSet& vote_points) {
  RimScene scene;
  if (!(edge > 0)) return scene;
  const std::vector<pairs::Rim> picked =
      pick(pairs::thin_rims(rims, edge), static_cast<std::size_t>(params.references));
  auto row = static_cast<std::uint32_t>(vote_points.points.rows());
  for (const pairs::LocalFrame& frame : pairs::frames_of(picked))
    scene.references.push_back({row++, frame});
  append(vote_points, picked);
  const float apart = static_cast<float>(params.partners) * edge;
  scene.partners = std::make_unique<const pairs::PairScene>(
      pairs::PairScene::of_thin(pairs::cloud_of(pairs::thin_rims(rims, apart)), apart));
  return scene;
}

std::tuple<PerObject<VoteSet>, FeatureSet> cast_rims(const PerObject<VoteSet>& given,
                                                     const FeatureSet& features, const Cloud& cloud,
                                                     const Scale& scale, const Params& params) {
  FeatureSet vote_points{features.points, features.normals, {}, {}, octaves_of(features)};
  if (params.references == 0) return {given, std::move(vote_points)};
  const auto tables = pairs::tables_of(given, &Model::rims);
  const pairs::SharedSteps steps = pairs::share_steps(tables);
  const std::vector<pairs::Rim> rims = seen_rims(cloud, scale.resolution);
  std::vector<RimScene> scenes;
  for (const float edge : steps.edges)
    scenes.push_back(make_scene(rims, edge, params, vote_points));
  std::vector<pairs::Source> sources;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const RimScene& scene = scenes[steps.of[i]];
    sources.push_back({tables[i], scene.partners.get(), &scene.references});
  }
  PerObject<VoteSet> votes = pairs::cast(
      given, sources,
      {static_cast<std::size_t>(params.poses), params.least_ratio, pairs::Turn::kKnown});
  return {std::move(votes), std::move(vote_points)};
}

const auto registered =
    graph::register_node("cast_rims", cast_rims,
                         "More pose votes: those of pairs of ends of faces, for what is flat.")
        .input("votes")
        .input("scene_features")
        .input("scene_cloud")
        .input("scale")
        .output("votes")
        .output("vote_points")
        .param("references", &Params::references, "",
               "Ends of faces that pairs start from, at most; 0: no votes of them.",
               graph::at_least(0))
        .param("poses", &Params::poses, "", "Votes of each of them, at most.",
               graph::in_range(1, 100))
        .param("least_ratio", &Params::least_ratio, "",
               "A pose with less than this share of the pairs of an end's best is no vote.",
               graph::in_range(0, 1))
        .param("partners", &Params::partners, "x rim_step",
               "How far apart the ends are that they are paired with.", graph::in_range(1, 10));

}  // namespace
}  // namespace posevote::vote
