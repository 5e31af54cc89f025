// SPDX-License-Identifier: BSD-3-Clause
#include "graph/parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace posevote::graph {

void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  if (count <= grain) return body(0, count);  // a task for it would take longer than a few searches
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(1, grain)),
                      [&body](const auto& range) { body(range.begin(), range.end()); });
  });
}

}  // namespace posevote::graph
