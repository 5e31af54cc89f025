// SPDX-License-Identifier: BSD-3-Clause
// The one parallel loop of the project. Isolated: a thread that waits here does not start another
// frame's work (without, bodies were seen re-entered up to 6 deep). Deterministic as long as each
// index writes only what belongs to it.
#pragma once

#include <cstddef>
#include <functional>

namespace posevote::graph {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), each at least `grain` long
/// where count allows. The first exception is rethrown.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(i) for every i in [0, count).
template <class Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  parallel_ranges(count, grain, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace posevote::graph
