// SPDX-License-Identifier: BSD-3-Clause
// What a pipeline that extends another one changes.
#pragma once

#include <vector>

#include "graph/description.hpp"

namespace posevote::graph {

/// A Wire here names a node, and says where it is named.
struct Variation {
  struct Replacement {
    Wire replaced;
    NodeDescription node;  ///< stands in its place; may have another name
  };
  enum class Place { kAtEnd, kBefore, kAfter, kInto };
  struct Insertion {
    NodeDescription node;
    Place place = Place::kAtEnd;
    Wire at;  ///< a node; for kInto a stream, whose readers so far read what this node makes of it
  };

  std::vector<Wire> removed;
  std::vector<Replacement> replaced;
  std::vector<Insertion> inserted;

  bool empty() const { return removed.empty() && replaced.empty() && inserted.empty(); }
};

/// Removes, then replaces, then inserts, each in the order in which it is written. A node or stream
/// that is not there, and a name that is taken, are problems.
void vary(PipelineDescription& pipeline, const Variation& variation,
          std::vector<Problem>& problems);

}  // namespace posevote::graph
