// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_writer.hpp"

#include <stdexcept>

#include "graph/output_file.hpp"
#include "nodes/formats/json_text.hpp"
#include "nodes/formats/results_tables.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::chrono::seconds kSyncInterval{1};

}  // namespace

ResultsTable::ResultsTable(fs::path file, Rows rows)
    : file_(std::move(file)), end_(fs::file_size(file_)), rows_(rows) {}

void ResultsTable::append(const ordered_json& frame) {
  const std::string rows = rows_(frame);
  graph::OutputFile out(file_, graph::OutputFile::Start::kThere);
  try {
    out.write_at(end_, rows);
  } catch (const std::runtime_error&) {
    out.cut(end_);
    throw;
  }
  out.close();
  end_ += rows.size();
}

ResultsWriter::ResultsWriter(const fs::path& out, const std::vector<std::string>& formats)
    : out_(out),
      synced_(std::chrono::steady_clock::now()),
      failures_(out / "failures.json", kFailuresTail) {
  for (const TableFormat& table : kTables)
    if (has(formats, table.format)) tables_.emplace_back(out / table.file, table.rows);
  if (has(formats, "json")) results_.emplace(out / "results.json", results_tail({}));
}

void ResultsWriter::write(const FrameReport& frame, const Detections& detections,
                          const std::vector<graph::NodeTimes>& nodes) {
  const ordered_json json = to_json(frame, detections);
  for (ResultsTable& table : tables_) table.append(json);
  if (results_) results_->append(record(json), results_tail(nodes));
  sync();
}

void ResultsWriter::write(const FailureReport& failure) {
  failures_.append(record({{"frame", failure.number},
                           {"file", failure.file.string()},
                           {"node", failure.node},
                           {"what", failure.what}}));
  sync();
}

void ResultsWriter::sync() {
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < kSyncInterval) return;
  synced_ = now;
  for (const ResultsTable& table : tables_) graph::sync_file(table.file());
  if (results_) graph::sync_file(out_ / "results.json");
  graph::sync_file(out_ / "failures.json");
}

}  // namespace posevote::formats
