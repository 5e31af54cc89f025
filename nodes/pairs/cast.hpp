// SPDX-License-Identifier: BSD-3-Clause
// How the nodes that vote by pairs of points do it, whatever the points are.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "graph/value.hpp"
#include "nodes/data/votes.hpp"
#include "nodes/pairs/pair_votes.hpp"

namespace posevote::pairs {

/// A point of a scan that pairs start from, and the row of the feature set that its votes are told
/// to come from: what is explained takes them along.
struct Reference {
  std::uint32_t row = 0;
  LocalFrame frame;
};

/// What the pairs of one object are sought in; null: it gets no votes.
struct Source {
  const PairTable* table = nullptr;
  const PairScene* scene = nullptr;
  const std::vector<Reference>* references = nullptr;
  std::vector<char> chosen = {};  ///< per reference, whether its pairs start there; empty: all do

  bool starts_at(std::size_t reference) const { return chosen.empty() || chosen[reference] != 0; }
};

/// A kind of table of each object's model; null where it has none.
std::vector<const PairTable*> tables_of(const PerObject<VoteSet>& votes,
                                        std::shared_ptr<const PairTable> Model::*kind);

/// Steps of tables, rounded to powers of the square root of two: so models of like size share
/// what is made of a scan, and which others are sought changes nothing.
struct SharedSteps {
  std::vector<float> edges;     ///< different ones [m]
  std::vector<std::size_t> of;  ///< per table: its edge; that of null is 0 m
};
SharedSteps share_steps(const std::vector<const PairTable*>& tables);

/// The votes given, and behind those of each object the ones of its pairs, by reference. `sources`:
/// one an object.
PerObject<VoteSet> cast(const PerObject<VoteSet>& given, const std::vector<Source>& sources,
                        const PeakOptions& options);

}  // namespace posevote::pairs
