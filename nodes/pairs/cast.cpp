// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/cast.hpp"

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
  std::vector<std::size_t> first{0};  // of each object's references among all
  for (const Source& source : sources)
    first.push_back(first.back() + (source.table ? source.references->size() : 0));
  std::vector<std::vector<PairPeak>> peaks(first.back());
  graph::parallel_ranges(peaks.size(), 16, [&](std::size_t begin, std::size_t end) {
    PairVotes counter;
    std::size_t object = 0;
    for (std::size_t i = begin; i < end; ++i) {
      while (i >= first[object + 1]) ++object;
      const Source& source = sources[object];
      peaks[i] = counter.peaks(*source.table, (*source.references)[i - first[object]].frame,
                               *source.scene, options);
    }
  });
  PerObject<VoteSet> votes = given;
  for (std::size_t object = 0; object < sources.size(); ++object) {
    if (first[object] == first[object + 1]) continue;
    auto more = std::make_shared<VoteSet>(given[object]);
    for (std::size_t i = first[object]; i < first[object + 1]; ++i)
      for (const PairPeak& peak : peaks[i])
        add_vote(*more, *sources[object].table, (*sources[object].references)[i - first[object]],
                 peak);
    votes.slots[object] = std::move(more);
  }
  return votes;
}

}  // namespace posevote::pairs
