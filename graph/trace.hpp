// SPDX-License-Identifier: BSD-3-Clause
// When each node worked on each frame: totals per node, and a file for a Chrome-trace viewer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "graph/output_file.hpp"
#include "graph/span.hpp"

namespace posevote::graph {

/// What a frame costs: the shares of all its calls [s]. Does not grow with the frames in flight.
double cost(const std::vector<Span>& spans);

/// Totals of one node over a run. Seconds are wall time of the calls, so over several threads and
/// frames they add up to more than the run took.
struct NodeTimes {
  std::string node;
  std::uint64_t calls = 0;
  double total = 0;  ///< [s]
  double max = 0;    ///< [s]

  double mean() const { return calls == 0 ? 0 : total / static_cast<double>(calls); }
};

/// Collects the spans of finished frames; used by one thread at a time.
class Trace {
 public:
  /// `nodes`: names in the order of a frame's spans.
  explicit Trace(const std::vector<std::string>& nodes);
  /// From now on also writes each span to `file` as a Chrome trace (chrome://tracing, Perfetto).
  void write_to(const std::filesystem::path& file);

  void add(const std::string& frame, const std::vector<Span>& spans);
  const std::vector<NodeTimes>& times() const { return times_; }
  /// Completes the file; says why it could not be written in full, or "".
  std::string close();

 private:
  void write(const std::string& text);

  std::vector<NodeTimes> times_;
  std::optional<OutputFile> file_;  ///< until it is complete, or cannot be written
  std::string problem_;
  bool first_ = true;
};

/// Aligned table of the totals: calls, total, mean, maximum and share of time, slowest first.
std::string time_table(const std::vector<NodeTimes>& times);

}  // namespace posevote::graph
