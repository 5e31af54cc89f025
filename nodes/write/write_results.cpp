// SPDX-License-Identifier: BSD-3-Clause
// What a run finds: OUT/results.json (pipelines/results.schema.json says what is in it),
// OUT/detections.csv (a row for each detection, with names), OUT/results.csv (BOP's format), as
// `format` asks; and OUT/failures.json.
//
// One frame at a time, in their order, when all other nodes of the frame are done, so that their
// times are known. After each frame all files are whole. Where there is no output folder
// nothing is written; begin_results must have made the files. One that cannot be written ends the
// run: no other frame could do better.
//
//   write_results: {in: [scene_file, detections], format: [json, csv, bop]}
#include <optional>

#include "graph/registry.hpp"
#include "nodes/formats/results_writer.hpp"

namespace posevote::write {
namespace {

struct Params {
  std::vector<std::string> format = formats::kAllResults;
};

/// The open files, and the times of all frames so far.
struct Results {
  std::optional<formats::ResultsWriter> writer;
  std::optional<graph::Trace> trace;

  void begin(const graph::FrameContext& context, const Params& params) {
    if (!writer) writer.emplace(context.out, params.format);
    std::vector<std::string> names;
    std::vector<graph::Span> spans;
    for (const graph::Stage& stage : context.stages) {
      names.push_back(stage.node);
      spans.push_back(stage.span);
    }
    if (!trace) trace.emplace(names);
    trace->add(context.name, spans);
  }
};

formats::FrameReport report_of(const SceneFile& file, const graph::FrameContext& context) {
  formats::FrameReport report{context.number, file, 0, {}, context.name};
  std::vector<graph::Span> spans;
  for (const graph::Stage& stage : context.stages) {
    spans.push_back(stage.span);
    if (stage.span.ran()) report.stages[stage.node] = stage.span.share * 1e-6;
    report.figures.insert(stage.figures.begin(), stage.figures.end());
    for (const std::string& what : stage.warnings) report.warnings.push_back({stage.node, what});
  }
  report.seconds = graph::cost(spans);
  report.scan_hash = file.hash;
  return report;
}

/// Runs `write`; what it throws ends the run.
template <class Write>
void or_end_run(const Write& write) {
  try {
    write();
  } catch (const std::exception& error) {
    throw graph::EndOfRun(error.what());
  }
}

void write_results(Results& results, const SceneFile& file, const Detections& detections,
                   const graph::FrameContext& context, const Params& params) {
  if (context.out.empty()) return;
  or_end_run([&] {
    results.begin(context, params);
    results.writer->write(report_of(file, context), detections, results.trace->times());
  });
}

void write_failure(Results& results, const graph::Failure& failure,
                   const graph::FrameContext& context, const Params& params) {
  if (context.out.empty()) return;
  or_end_run([&] {
    results.begin(context, params);
    results.writer->write({context.number, context.file, failure.node, failure.what});
  });
}

const auto registered =
    graph::register_stateful_node<Results>(
        "write_results", write_results,
        "What is found and what failed: results.json, detections.csv, results.csv (BOP), "
        "failures.json.")
        .input("scene_file")
        .input("detections")
        .param("format", &Params::format, "",
               "Which files: json results.json, csv detections.csv, bop results.csv; without json "
               "no report, and no run that is resumed.",
               graph::one_of(formats::kAllResults))
        .last()
        .on_failure(write_failure);

}  // namespace
}  // namespace posevote::write
