// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/cast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "graph/parallel.hpp"

namespace posevote::pairs {
namespace {

/// The model's point lies in the reference, normal on normal, and is turned about it.
void add_vote(VoteSet& votes, const PairTable& table, const Reference& reference,
              const PairPeak& peak) {
  const LocalFrame& from = table.points()[peak.point];
  const Eigen::Matrix3f rotation = reference.frame.axes() *
                                   Eigen::AngleAxisf(peak.turn, Eigen::Vector3f::UnitZ()).matrix() *
                                   from.axes().transpose();
  votes.add_single(reference.frame.point + rotation * (votes.model->center - from.point),
                   Eigen::Quaternionf(rotation), reference.row);
}

/// A copy that takes so many single votes more without another.
VoteSet with_room(const VoteSet& given, std::size_t more) {
  VoteSet votes;
  votes.model = given.model;
  votes.votes_per_correspondence = given.votes_per_correspondence;
  votes.scene_feature = given.scene_feature;
  votes.single_feature = given.single_feature;
  constexpr std::array kColumns = {&VoteSet::tx, &VoteSet::ty, &VoteSet::tz, &VoteSet::qw,
                                   &VoteSet::qx, &VoteSet::qy, &VoteSet::qz};
  graph::parallel_for(kColumns.size(), 1, [&](std::size_t c) {
    const std::vector<float>& from = given.*kColumns[c];
    std::vector<float>& to = votes.*kColumns[c];
    to.reserve(from.size() + more);
    to.assign(from.begin(), from.end());
  });
  return votes;
}

/// Objects whose pairs start from the same references in the same scene: what is around those is
/// looked up once.
struct Group {
  std::vector<std::size_t> objects;
  float reach = 0;  ///< of the farthest [m]
};

std::vector<Group> group_by_scene(const std::vector<Source>& sources) {
  std::vector<Group> groups;
  for (std::size_t object = 0; object < sources.size(); ++object) {
    const Source& source = sources[object];
    if (!source.table) continue;
    auto at = std::ranges::find_if(groups, [&](const Group& one) {
      const Source& first = sources[one.objects.front()];
      return first.scene == source.scene && first.references == source.references;
    });
    if (at == groups.end()) at = groups.emplace(at);
    at->objects.push_back(object);
    at->reach = std::max(at->reach, source.table->reach());
  }
  return groups;
}

/// Of each object and each of its references.
using Peaks = std::vector<std::vector<std::vector<PairPeak>>>;

Peaks find_peaks(const std::vector<Source>& sources, const PeakOptions& options) {
  Peaks peaks(sources.size());
  struct Start {
    const Group* group;
    std::size_t reference;
  };
  std::vector<Start> starts;
  const std::vector<Group> groups = group_by_scene(sources);
  for (const Group& one : groups) {
    const std::size_t references = sources[one.objects.front()].references->size();
    for (const std::size_t object : one.objects) peaks[object].resize(references);
    for (std::size_t i = 0; i < references; ++i)
      if (std::ranges::any_of(one.objects, [&](auto k) { return sources[k].starts_at(i); }))
        starts.push_back({&one, i});
  }
  graph::parallel_ranges(starts.size(), 8, [&](std::size_t begin, std::size_t end) {
    PairVotes counter;
    for (std::size_t i = begin; i < end; ++i) {
      const auto [group, reference] = starts[i];
      const Source& first = sources[group->objects.front()];
      counter.go_to((*first.references)[reference].frame, *first.scene, group->reach);
      for (const std::size_t object : group->objects)
        if (sources[object].starts_at(reference))
          peaks[object][reference] = counter.peaks(*sources[object].table, options);
    }
  });
  return peaks;
}

}  // namespace

std::vector<const PairTable*> tables_of(const PerObject<VoteSet>& votes,
                                        std::shared_ptr<const PairTable> Model::*kind) {
  std::vector<const PairTable*> tables;
  for (const auto& slot : votes.slots)
    tables.push_back(slot->model ? ((*slot->model).*kind).get() : nullptr);
  return tables;
}

SharedSteps share_steps(const std::vector<const PairTable*>& tables) {
  SharedSteps steps;
  std::map<float, std::size_t> by_edge;
  for (const PairTable* table : tables) {
    const float edge = table ? std::exp2(std::round(2 * std::log2(table->step())) / 2) : 0;
    const auto [at, is_new] = by_edge.emplace(edge, steps.edges.size());
    steps.of.push_back(at->second);
    if (is_new) steps.edges.push_back(edge);
  }
  return steps;
}

PerObject<VoteSet> cast(const PerObject<VoteSet>& given, const std::vector<Source>& sources,
                        const PeakOptions& options) {
  const Peaks peaks = find_peaks(sources, options);
  PerObject<VoteSet> votes = given;
  graph::parallel_for(sources.size(), 1, [&](std::size_t object) {
    if (peaks[object].empty()) return;
    std::size_t count = 0;
    for (const auto& of_reference : peaks[object]) count += of_reference.size();
    auto more = std::make_shared<VoteSet>(with_room(given[object], count));
    for (std::size_t i = 0; i < peaks[object].size(); ++i)
      for (const PairPeak& peak : peaks[object][i])
        add_vote(*more, *sources[object].table, (*sources[object].references)[i], peak);
    votes.slots[object] = std::move(more);
  });
  return votes;
}

}  // namespace posevote::pairs
