// SPDX-License-Identifier: BSD-3-Clause
// Adds pose votes of point pairs: what no local shape tells, as the flat sides of a box, the whole of
// the object does.
//
// Drost, Ulrich, Navab, Ilic, CVPR 2010, section 3.3: a scan point is paired with each other point
// within the model's diagonal; the model's pairs of the same feature each say which of the model's
// points the first one would be, and at which turn about its normal. Where many agree, that is a
// pose. Here it is not an answer but a vote beside those of the correspondences, and their density
// decides. A pair counts once however often a plane has it (Vidal, Lin, Llado, Marti, Sensors 2018);
// pairs within one plane do not count at all (pair_key.hpp). The scan is thinned to about one point
// a step of the pairs, once for all models whose steps are alike.
//
// Where scan and model have colours, a pair whose colours change from one end to the other as
// the model's do counts several times (pairs/color_step.hpp); one of other colours still
// counts, so that a scan of wrong ones loses little. For a fiftieth of an image's time the
// votes gather at the poses that are right, whose lead over the best elsewhere grows (YCB-Video
// 1.05 to 1.15, painted `household` 1.8 to 2.2).
//
// And its pairs start from points whose colours are more often the object's than the scan's
// (pairs/color_choice.hpp), which costs nothing: of 181 things, plainly painted, in clutter 167
// instead of 160 are found.
//
// The points that pairs start from are feature points, so that what is explained takes its votes
// along. Time: references x pairs of each, some 0.1 ms a reference.
//
// An object without pairs keeps its votes as they are; so does one that no point is near.
//
//   cast_pairs: {in: [circle_votes, scene_features, scene_cloud], out: votes, references: 300}
#include <algorithm>
#include <memory>
#include <optional>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/pairs/cast.hpp"
#include "nodes/pairs/color_choice.hpp"

namespace posevote::vote {
namespace {

struct Params {
  int references = 300;
  int poses = 2;
  double least_ratio = 0.7;
  int like_color = 4;
};

/// Some of the finest octave's features, evenly taken.
std::vector<pairs::Reference> pick_references(const FeatureSet& features, std::size_t most) {
  const Octave finest = octaves_of(features).front();
  const std::size_t rows = finest.end - finest.begin;
  const std::size_t count = std::min(rows, most);
  std::vector<pairs::Reference> references;
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<std::uint32_t>(finest.begin + i * rows / count);
    const Eigen::Vector3f point = features.points.row(row).transpose();
    const Eigen::Vector3f normal = features.normals.row(row).transpose();
    if (point.allFinite() && normal.allFinite() && !normal.isZero())
      references.push_back({row, {point, normal}});
  }
  return references;
}

/// The scan's surface, as fine as each of the edges [m].
std::vector<std::unique_ptr<const pairs::PairScene>> scenes_of(const Cloud& cloud,
                                                               const std::vector<float>& edges) {
  std::vector<std::unique_ptr<const pairs::PairScene>> scenes(edges.size());
  graph::parallel_for(edges.size(), 1, [&](std::size_t i) {
    if (edges[i] > 0) scenes[i] = std::make_unique<const pairs::PairScene>(cloud, edges[i]);
  });
  return scenes;
}

PerObject<VoteSet> cast_pairs(const PerObject<VoteSet>& given, const FeatureSet& features,
                              const Cloud& cloud, const Params& params) {
  const auto most = static_cast<std::size_t>(params.references);
  const bool has_colors = cloud.colors.rows() > 0;
  const std::vector<pairs::Reference> references =
      pick_references(features, has_colors ? pairs::ColorChoice::kOneOf * most : most);
  if (references.empty() || given.size() == 0) return given;
  const auto tables = pairs::tables_of(given, &Model::pairs);
  const pairs::SharedSteps steps = pairs::share_steps(tables);
  const auto scenes = scenes_of(cloud, steps.edges);
  std::optional<pairs::ColorChoice> choice;
  if (has_colors) choice.emplace(references, cloud, std::ranges::max(steps.edges));
  std::vector<pairs::Source> sources;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    sources.push_back({tables[i], scenes[steps.of[i]].get(), &references});
    if (choice && tables[i]) sources.back().chosen = choice->choose(*tables[i], most);
  }
  return pairs::cast(given, sources,
                     {static_cast<std::size_t>(params.poses), params.least_ratio,
                      pairs::Turn::kOpen, static_cast<std::uint16_t>(params.like_color)});
}

const auto registered =
    graph::register_node("cast_pairs", cast_pairs,
                         "More pose votes: those of point pairs across the whole object.")
        .input("votes")
        .input("scene_features")
        .input("scene_cloud")
        .output("votes")
        .param("references", &Params::references, "",
               "Feature points that pairs start from, at most; 0: no votes of pairs.",
               graph::at_least(0))
        .param("poses", &Params::poses, "", "Votes of each of them, at most.",
               graph::in_range(1, 100))
        .param("least_ratio", &Params::least_ratio, "",
               "A pose with less than this share of the pairs of a point's best is no vote.",
               graph::in_range(0, 1))
        .param("like_color", &Params::like_color, "",
               "Times that a pair counts whose colours change from one end to the other as the "
               "model's do, where scan and model have colours; 1: they do not matter.",
               graph::in_range(1, 100));

}  // namespace
}  // namespace posevote::vote
