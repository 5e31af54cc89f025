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
// The points that pairs start from are feature points, so that what is explained takes its votes
// along. Time: references x pairs of each, some 0.1 ms a reference.
//
// An object without pairs keeps its votes as they are; so does one that no point is near.
//
//   cast_pairs: {in: [circle_votes, scene_features, scene_cloud], out: votes, references: 300}
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/votes.hpp"
#include "nodes/pairs/pair_table.hpp"
#include "nodes/pairs/pair_votes.hpp"

namespace posevote::vote {
namespace {

struct Params {
  int references = 300;
  int poses = 2;
  double least_ratio = 0.7;
};

/// A feature point that pairs start from.
struct Reference {
  std::uint32_t row = 0;
  pairs::LocalFrame frame;
};

/// Some of the finest octave's features, evenly taken.
std::vector<Reference> pick_references(const FeatureSet& features, std::size_t most) {
  const Octave finest = octaves_of(features).front();
  const std::size_t rows = finest.end - finest.begin;
  const std::size_t count = std::min(rows, most);
  std::vector<Reference> references;
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<std::uint32_t>(finest.begin + i * rows / count);
    const Eigen::Vector3f point = features.points.row(row).transpose();
    const Eigen::Vector3f normal = features.normals.row(row).transpose();
    if (point.allFinite() && normal.allFinite() && !normal.isZero())
      references.push_back({row, {point, normal}});
  }
  return references;
}

/// The scan's surface for each model with pairs, as fine as its steps, rounded to a power of
/// the square root of two: so models of like size share one, and which others are sought changes
/// nothing.
class PairScenes {
 public:
  PairScenes(const PerObject<VoteSet>& votes, const Cloud& cloud) {
    std::map<float, std::size_t> by_edge;
    std::vector<float> edges;
    for (const auto& slot : votes.slots) {
      const pairs::PairTable* table = table_of(*slot);
      const float edge = table ? std::exp2(std::round(2 * std::log2(table->step())) / 2) : 0;
      const auto [at, is_new] = by_edge.emplace(edge, edges.size());
      scene_of_.push_back(at->second);
      if (is_new) edges.push_back(edge);
    }
    scenes_.resize(edges.size());
    graph::parallel_for(edges.size(), 1, [&](std::size_t i) {
      if (edges[i] > 0) scenes_[i] = std::make_unique<const pairs::PairScene>(cloud, edges[i]);
    });
  }

  static const pairs::PairTable* table_of(const VoteSet& votes) {
    return votes.model ? votes.model->pairs.get() : nullptr;
  }

  const pairs::PairScene& operator[](std::size_t object) const {
    return *scenes_[scene_of_[object]];
  }

 private:
  std::vector<std::size_t> scene_of_;
  std::vector<std::unique_ptr<const pairs::PairScene>> scenes_;
};

/// The model's point lies in the reference, normal on normal, and is turned about it.
void add_vote(VoteSet& votes, const Reference& reference, const pairs::PairPeak& peak) {
  const pairs::LocalFrame& from = votes.model->pairs->points()[peak.point];
  const Eigen::Matrix3f rotation = reference.frame.axes() *
                                   Eigen::AngleAxisf(peak.turn, Eigen::Vector3f::UnitZ()).matrix() *
                                   from.axes().transpose();
  votes.add_single(reference.frame.point + rotation * (votes.model->center - from.point),
                   Eigen::Quaternionf(rotation), reference.row);
}

PerObject<VoteSet> cast_pairs(const PerObject<VoteSet>& given, const FeatureSet& features,
                              const Cloud& cloud, const Params& params) {
  PerObject<VoteSet> votes = given;
  const std::vector<Reference> references =
      pick_references(features, static_cast<std::size_t>(params.references));
  if (references.empty()) return votes;
  const PairScenes scenes(given, cloud);
  const std::size_t count = references.size();
  std::vector<std::vector<pairs::PairPeak>> peaks(given.size() * count);
  graph::parallel_ranges(peaks.size(), 16, [&](std::size_t begin, std::size_t end) {
    pairs::PairVotes counter;
    for (std::size_t i = begin; i < end; ++i)
      if (const pairs::PairTable* table = PairScenes::table_of(given[i / count]))
        peaks[i] = counter.peaks(*table, references[i % count].frame, scenes[i / count],
                                 static_cast<std::size_t>(params.poses), params.least_ratio);
  });
  for (std::size_t object = 0; object < given.size(); ++object) {
    auto more = std::make_shared<VoteSet>(given[object]);
    for (std::size_t i = 0; i < count; ++i)
      for (const pairs::PairPeak& peak : peaks[object * count + i])
        add_vote(*more, references[i], peak);
    votes.slots[object] = std::move(more);
  }
  return votes;
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
               graph::in_range(0, 1));

}  // namespace
}  // namespace posevote::vote
