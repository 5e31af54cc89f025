// SPDX-License-Identifier: BSD-3-Clause
// When a node worked on a frame.
#pragma once

namespace posevote::graph {

/// One call of a node, in microseconds since the run began.
struct Span {
  double begin = 0;
  double end = -1;  ///< before `begin`: the node did not run (an earlier one failed)
  int thread = 0;
  double share = 0;  ///< of the time between, when it is divided among all calls then at work

  bool ran() const { return end >= begin; }
  double seconds() const { return ran() ? (end - begin) * 1e-6 : 0; }
};

}  // namespace posevote::graph
