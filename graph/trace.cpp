// SPDX-License-Identifier: BSD-3-Clause
#include "graph/trace.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace posevote::graph {

double cost(const std::vector<Span>& spans) {
  double share = 0;
  for (const Span& span : spans) share += span.share;
  return share * 1e-6;
}

Trace::Trace(const std::vector<std::string>& nodes) {
  for (const std::string& name : nodes) times_.push_back({name});
}

void Trace::write_to(const std::filesystem::path& file) {
  try {
    file_.emplace(file, OutputFile::Start::kAnew);
  } catch (const std::runtime_error& error) {
    problem_ = error.what();
  }
  write("{\"displayTimeUnit\": \"ms\", \"traceEvents\": [");
}

/// It is a help, not the results: what goes wrong is said in the end.
void Trace::write(const std::string& text) {
  if (!file_) return;
  try {
    file_->write(text);
  } catch (const std::runtime_error& error) {
    problem_ = error.what();
    file_.reset();
  }
}

void Trace::add(const std::string& frame, const std::vector<Span>& spans) {
  std::string events;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Span& span = spans[i];
    if (!span.ran()) continue;
    NodeTimes& times = times_[i];
    ++times.calls;
    times.total += span.seconds();
    times.max = std::max(times.max, span.seconds());
    if (!file_) continue;
    const nlohmann::json event = {{"name", times.node},
                                  {"cat", "node"},
                                  {"ph", "X"},
                                  {"ts", span.begin},
                                  {"dur", span.end - span.begin},
                                  {"pid", 1},
                                  {"tid", span.thread},
                                  {"args", {{"frame", frame}}}};
    constexpr auto kReplace = nlohmann::json::error_handler_t::replace;  // names may not be UTF-8
    events += (first_ ? "\n" : ",\n") + event.dump(-1, ' ', false, kReplace);
    first_ = false;
  }
  write(events);
}

std::string Trace::close() {
  write("\n]}\n");
  try {
    if (file_) file_->close();
  } catch (const std::runtime_error& error) {
    problem_ = error.what();
  }
  file_.reset();
  return problem_;
}

std::string time_table(const std::vector<NodeTimes>& times) {
  std::vector<NodeTimes> sorted = times;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const NodeTimes& a, const NodeTimes& b) { return a.total > b.total; });
  double sum = 0;
  std::size_t width = 4;
  for (const NodeTimes& node : sorted) {
    sum += node.total;
    width = std::max(width, node.node.size());
  }
  char line[256];
  std::snprintf(line, sizeof line, "%-*s %8s %10s %10s %10s %7s\n", static_cast<int>(width), "node",
                "calls", "total s", "mean ms", "max ms", "share");
  std::string table = line;
  for (const NodeTimes& node : sorted) {
    std::snprintf(line, sizeof line, "%-*s %8llu %10.3f %10.3f %10.3f %6.1f%%\n",
                  static_cast<int>(width), node.node.c_str(),
                  static_cast<unsigned long long>(node.calls), node.total, node.mean() * 1e3,
                  node.max * 1e3, sum > 0 ? 100 * node.total / sum : 0.0);
    table += line;
  }
  return table;
}

}  // namespace posevote::graph
