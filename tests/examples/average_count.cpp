// SPDX-License-Identifier: BSD-3-Clause
// Example of a node with a state: how many detections a frame has, averaged over the last frames;
// one that failed counts as none. Frames come one by one, in their order, whatever overtakes what
// before it, so the same input gives the same averages at any number of threads.
//
//   average_count: {in: detections, out: average, frames: 10}
#include <deque>
#include <numeric>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"

namespace posevote::examples {
namespace {

struct Params {
  int frames = 10;
};

/// Made anew for each run.
struct LastCounts {
  std::deque<double> counts;

  void add(std::size_t count, const Params& params) {
    counts.push_back(static_cast<double>(count));
    if (std::ssize(counts) > params.frames) counts.pop_front();
  }
};

double average_count(LastCounts& last, const Detections& detections, const Params& params) {
  last.add(detections.items.size(), params);
  return std::accumulate(last.counts.begin(), last.counts.end(), 0.0) /
         static_cast<double>(last.counts.size());
}

void count_failure(LastCounts& last, const graph::Failure&, const graph::FrameContext&,
                   const Params& params) {
  last.add(0, params);
}

const auto registered =
    graph::register_stateful_node<LastCounts>("average_count", average_count,
                                              "Detections a frame, averaged over the last ones.")
        .input("detections")
        .output("average")
        .on_failure(count_failure)
        .param("frames", &Params::frames, "frames", "So many are averaged.", graph::at_least(1));

}  // namespace
}  // namespace posevote::examples
