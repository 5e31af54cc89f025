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
  struct Insertion {
    NodeDescription node;
    Wire beside;  ///< empty: at the end
    bool before = false;
  };

  std::vector<Wire> removed;
  std::vector<Replacement> replaced;
  std::vector<Insertion> inserted;

  bool empty() const { return removed.empty() && replaced.empty() && inserted.empty(); }
};

/// Removes, then replaces, then inserts, each in the order in which it is written. A node that is
/// not there, and a name that is taken, are problems.
void vary(PipelineDescription& pipeline, const Variation& variation,
          std::vector<Problem>& problems);

}  // namespace posevote::graph
