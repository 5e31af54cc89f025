// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "nodes/formats/file_bytes.hpp"
#include "tools/quantiles.hpp"
#include "tools/report/sections.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFailures = 1000;
constexpr std::size_t kBins = 20;  // of confidences from 0 to 1

std::string figure(const std::string& what, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", what, value);
}

std::string summary(const RunResults& run) {
  std::size_t detections = 0;
  std::vector<double> seconds, latencies;
  for (const AnsweredFrame& frame : run.frames) {
    detections += frame.found.size();
    if (std::isfinite(frame.seconds)) seconds.push_back(frame.seconds);
    if (std::isfinite(frame.latency)) latencies.push_back(frame.latency);
  }
  std::string text = "<dl>\n" + figure("frames answered", std::to_string(run.frames.size())) +
                     figure("frames failed", std::to_string(run.failures.size())) +
                     figure("detections", std::to_string(detections));
  if (!seconds.empty())
    text += figure("median time of a frame", html::number(median(seconds), 2) + " s") +
            figure("longest",
                   html::number(*std::max_element(seconds.begin(), seconds.end()), 2) + " s");
  if (latencies.size() > 1) text += figure("latency of a frame", latency_text(latencies));
  text += "</dl>\n";
  if (run.torn > 0)
    text += html::paragraph(fmt::format(
        "Torn lines left out: {}. The run was stopped while it wrote, or the disk is full.",
        run.torn));
  return text;
}

/// How many confidences lie where from 0 to 1.
std::string histogram(const std::vector<double>& confidences) {
  std::array<std::size_t, kBins> bins{};
  for (const double confidence : confidences)
    ++bins[static_cast<std::size_t>(std::clamp(confidence * kBins, 0.0, kBins - 1.0))];
  const std::size_t most = std::max<std::size_t>(1, *std::max_element(bins.begin(), bins.end()));
  std::string text =
      "<svg class=\"bars\" width=\"200\" height=\"40\" viewBox=\"0 0 200 40\" role=\"img\" "
      "aria-label=\"histogram of the confidences\">\n";
  for (std::size_t b = 0; b < kBins; ++b) {
    if (bins[b] == 0) continue;
    const double height = 38.0 * static_cast<double>(bins[b]) / static_cast<double>(most);
    const double from = static_cast<double>(b) / kBins;
    text += fmt::format(
        "<rect x=\"{}\" y=\"{:.1f}\" width=\"9\" height=\"{:.1f}\">"
        "<title>{:.2f} to {:.2f}: {}</title></rect>\n",
        10 * b, 39 - height, height, from, from + 1.0 / kBins, bins[b]);
  }
  return text + "<path d=\"M0 39.5H200\"/></svg>";
}

/// How often each model was found; also those that never were.
std::string models(const RunResults& run, const page::ShownRun& inputs) {
  struct Model {
    std::vector<double> confidences;
    std::size_t frames = 0;
    const AnsweredFrame* last = nullptr;
  };
  std::map<std::string, Model> models;
  for (const SoughtModel& model : inputs.models()) models[model.name];
  for (const LeftOutModel& model : run.left_out) models.erase(model.name);  // told above
  for (const AnsweredFrame& frame : run.frames) {
    for (const ReportedObject& best : frame.rejected) models[best.model];
    for (const ReportedObject& found : frame.found) {
      Model& model = models[found.model];
      if (std::isfinite(found.confidence)) model.confidences.push_back(found.confidence);
      if (std::exchange(model.last, &frame) != &frame) ++model.frames;
    }
  }
  if (models.empty()) return "";
  std::vector<html::Row> rows;
  rows.reserve(models.size());
  for (const auto& [name, model] : models)
    rows.push_back({escape_markup(name), std::to_string(model.confidences.size()),
                    std::to_string(model.frames),
                    model.confidences.empty() ? "-" : html::number(median(model.confidences), 3),
                    model.frames == 0 ? "never found" : histogram(model.confidences)});
  return html::heading("Models") + html::table({{"model"},
                                                {"detections", html::Kind::kNumber},
                                                {"in frames", html::Kind::kNumber},
                                                {"median confidence", html::Kind::kNumber},
                                                {"confidences, 0 to 1"}},
                                               rows);
}

std::string left_out(const RunResults& run) {
  if (run.left_out.empty()) return "";
  std::vector<html::Row> rows;
  for (const LeftOutModel& model : run.left_out)
    rows.push_back({escape_markup(model.name), escape_markup(model.why)});
  return html::heading("Models left out") +
         html::table({{"model"}, {"cause", html::Kind::kLong}}, rows);
}

/// A share of the whole.
std::string bar(double share) {
  return fmt::format(
      "<svg class=\"bars\" width=\"200\" height=\"12\" viewBox=\"0 0 200 12\" role=\"img\" "
      "aria-label=\"share\"><rect y=\"1\" width=\"{:.1f}\" height=\"10\"/></svg>",
      std::isfinite(share) ? 200 * share : 0.0);
}

std::string stages(const RunResults& run) {
  if (run.stages.empty()) return "";
  double sum = 0;
  for (const graph::NodeTimes& stage : run.stages) sum += stage.total;
  std::vector<html::Row> rows;
  for (const graph::NodeTimes& stage : run.stages)
    rows.push_back({escape_markup(stage.node), html::number(stage.total, 2),
                    html::number(1000 * stage.mean(), 1), html::number(1000 * stage.max, 1),
                    html::number(100 * stage.total / sum, 1), bar(stage.total / sum)});
  return html::heading("Time per node") + html::table({{"node"},
                                                       {"total [s]", html::Kind::kNumber},
                                                       {"mean [ms]", html::Kind::kNumber},
                                                       {"longest [ms]", html::Kind::kNumber},
                                                       {"share [%]", html::Kind::kNumber},
                                                       {""}},
                                                      rows);
}

std::string failures(const RunResults& run) {
  if (run.failures.empty()) return "";
  std::map<std::string, std::size_t> nodes;
  std::vector<html::Row> rows;
  for (const FailedFrame& failure : run.failures) {
    ++nodes[failure.node];
    rows.push_back({html::number(failure.number, 0), html::path(failure.file),
                    escape_markup(failure.node), escape_markup(failure.what)});
  }
  std::string counts;
  for (const auto& [node, count] : nodes)
    counts += fmt::format("{}{} in {}", counts.empty() ? "" : ", ", count, node);
  return html::heading("Failures") + html::paragraph(counts + ".") +
         html::table({{"frame", html::Kind::kNumber},
                      {"scan", html::Kind::kLong},
                      {"node"},
                      {"cause", html::Kind::kLong}},
                     rows, kMostFailures);
}

std::string parameters(const fs::path& folder) {
  try {
    const formats::FileBytes yaml = formats::read_file(folder / "effective.yaml");
    return html::heading("Parameters") +
           html::fold("effective.yaml",
                      "<pre>" + escape_markup(std::string(yaml.view())) + "</pre>\n");
  } catch (const std::runtime_error&) {
    return "";
  }
}

/// What was typed; more than once where a run was resumed.
std::string command_lines(const std::vector<RunStart>& starts) {
  if (starts.empty()) return "";
  std::string lines;
  for (const RunStart& start : starts)
    lines += "cd " + shell_line({start.folder}) + "\n" + shell_line(start.command) + "\n";
  return html::heading("Command line") + "<pre class=\"command\">" + escape_markup(lines) +
         "</pre>\n";
}

std::string notes(const page::ShownRun& inputs) {
  std::string text;
  for (const std::string& note : inputs.notes()) text += html::paragraph(note);
  return text;
}

}  // namespace

html::Section run_section(const fs::path& folder, const std::string& where,
                          const page::TruthSource& truth, const page::RunView& view,
                          const std::string& id) {
  const RunResults run = read_run(folder);
  page::ShownRun inputs(folder, truth);
  const std::string viewer = page::run_markup(folder, run, inputs, view, id);
  return {where.empty() ? "Run" : where, summary(run) + left_out(run) + notes(inputs) + viewer +
                                             models(run, inputs) + stages(run) + failures(run) +
                                             command_lines(inputs.starts()) + parameters(folder)};
}

}  // namespace posevote
