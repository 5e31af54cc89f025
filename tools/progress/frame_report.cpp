// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress/frame_report.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "tools/text.hpp"

namespace posevote {
namespace {

std::vector<std::string> node_names(const graph::Plan& plan) {
  std::vector<std::string> names;
  for (const graph::PlannedNode& node : plan.nodes) names.push_back(node.name);
  return names;
}

/// "0 found" alone explains nothing.
std::string nearest_text(const Detection& best, const std::string& out, const std::string& scan) {
  const auto worst = std::max_element(best.against.begin(), best.against.end());
  return "    the best candidate, " + printable(best.model) + ": " + best.why +
         "; most against it: " + kClueNames[std::size_t(worst - best.against.begin())] +
         "\n    why: posevote explain " + quote_for_shell(printable(out)) + " --scene " +
         quote_for_shell(printable(scan)) + "\n";
}

std::string figures_text(const graph::Figures& figures) {
  std::ostringstream text;
  for (const auto& [name, values] : figures) {
    text << (text.tellp() == 0 ? "    measured: " : ", ") << name;
    for (const double value : values) text << ' ' << value;
  }
  return figures.empty() ? "" : text.str() + "\n";
}

std::string detection_text(const Detection& item) {
  return format("    %-24s", printable(item.model).c_str()) +
         format(" confidence %.2f  inliers %.0f %%  rms %.2f mm\n", item.confidence,
                100 * item.inlier_fraction, 1e3 * item.rmse);
}

}  // namespace

FrameReport::FrameReport(const RunCommand& command, const graph::Plan& plan, std::size_t count,
                         const graph::Activity& activity, const std::atomic<bool>& interrupted)
    : command_(command),
      count_(count),
      trace_(node_names(plan)),
      progress_(
          {count > 0 ? "frames" : "following", count, &activity, !command.quiet, &interrupted}) {
  trace_.write_to(std::filesystem::path(command.out) / "trace.json");
}

void FrameReport::add(const graph::FrameResult<Detections>& result) {
  ++reported_;
  trace_.add(result.context.name, result.spans);
  for (const graph::Warning& warning : result.warnings)
    spdlog::warn("{}: {}: {}", printable(result.context.file.string()), warning.node, warning.what);
  if (result.failure) {
    ++failed_;
    spdlog::error("{}: {}: {}", printable(result.context.file.string()), result.failure->node,
                  result.failure->what);
  } else {
    found_ += result.result->items.size();
    if (command_.verbose ||
        (command_.lines && !command_.quiet && 0 < count_ && count_ <= kFewFrames))
      say(result);
  }
  progress_.advance();
  progress_.note((count_ > 0 ? "" : std::to_string(reported_) + " frames, ") +
                 std::to_string(found_) + " found, " + std::to_string(failed_) + " failed");
}

void FrameReport::finish() {
  if (const std::string problem = trace_.close(); !problem.empty()) spdlog::warn("{}", problem);
  if (command_.verbose) std::cout << "\n" << graph::time_table(trace_.times());
}

void FrameReport::say(const graph::FrameResult<Detections>& result) const {
  const Detections& detections = *result.result;
  std::string text = "[" + std::to_string(reported_) +
                     (count_ > 0 ? "/" + std::to_string(count_) : "") + "] " +
                     printable(result.context.file.filename().string()) + ": " +
                     std::to_string(detections.items.size()) +
                     format(" found (%.2f s)\n", graph::cost(result.spans));
  for (const Detection& item : detections.items) text += detection_text(item);
  if (detections.items.empty() && !detections.rejected.empty())
    text += nearest_text(detections.rejected.front(), command_.out, result.context.name);
  if (command_.verbose) text += figures_text(result.figures);
  std::cout << text << std::flush;
}

}  // namespace posevote
