// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "graph/write_file.hpp"
#include "nodes/formats/json_text.hpp"
#include "nodes/formats/results_tables.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kFailuresTail = "\n]\n";

/// The tables that a format asks for.
struct TableFormat {
  const char* format;
  const char* file;
  const char* header;
  ResultsTable::Rows rows;
};
constexpr TableFormat kTables[] = {{"bop", "results.csv", kBopHeader, bop_rows},
                                   {"csv", "detections.csv", kTableHeader, table_rows}};

bool has(const std::vector<std::string>& formats, const std::string& format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

[[noreturn]] void fail_changed(const fs::path& results, std::size_t frame,
                               const std::string& before, const std::string& now) {
  throw std::invalid_argument(results.string() + ": frame " + std::to_string(frame) + " is " +
                              before + " there, now it is " + now +
                              ": the scans have changed; choose another --out");
}

/// Whether two files that can both be read hold something else. Scenes of one set share names.
bool differ(const fs::path& a, const fs::path& b) {
  std::error_code none;
  if (!fs::is_regular_file(a, none) || !fs::is_regular_file(b, none) || fs::equivalent(a, b, none))
    return false;
  if (fs::file_size(a, none) != fs::file_size(b, none)) return true;
  std::ifstream left(a, std::ios::binary), right(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return !std::equal(Bytes(left), Bytes(), Bytes(right), Bytes());
}

/// The same scans may be reached by another path, or have been moved.
void check_same_scans(const fs::path& results, const std::vector<ordered_json>& frames,
                      const std::map<std::size_t, fs::path>& scans) {
  for (const ordered_json& frame : frames) {
    const auto scan = scans.find(frame.at("frame").get<std::size_t>());
    if (scan == scans.end()) continue;
    const fs::path before = frame.at("file").get<std::string>(), now = scan->second;
    if (line(now.filename().string()) != line(before.filename().string()))
      fail_changed(results, scan->first, before.filename(), now.filename());
    if (differ(before, now)) fail_changed(results, scan->first, before, now);
  }
}

/// What is answered is read from results.json alone.
void check_begin(const fs::path& out, bool resume, const std::vector<std::string>& formats) {
  if (resume && !has(formats, "json"))
    throw std::invalid_argument(out.string() +
                                ": cannot be resumed without results.json, which says what is "
                                "answered; give --format json too, or --overwrite");
  if (resume) return;
  for (const char* file : {"results.csv", "results.json", "detections.csv", "failures.json"})
    if (fs::exists(out / file))
      throw std::invalid_argument(
          out.string() +
          ": holds another run; choose another --out, or give --resume or --overwrite");
}

/// Keeps the failures of frames that are another shard's; this run's are tried again.
void begin_failures(const fs::path& file, const std::map<std::size_t, fs::path>& scans) {
  const std::vector<ordered_json> before = read_frames(file, "what").items;
  AppendJson list(file, "[", kFailuresTail);
  for (const ordered_json& failure : before)
    if (!scans.contains(failure.at("frame").get<std::size_t>())) list.append(line(failure));
}

void require(const std::ostream& stream, const fs::path& file) {
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be written: " + graph::cause_of(errno));
}

/// Beside the old file, so that a crash here loses nothing of it.
fs::path beside(const fs::path& file) { return file.string() + ".new"; }

/// All rows anew: a killed run may have written half of one.
void begin_table(const fs::path& out, const TableFormat& table,
                 const std::vector<ordered_json>& frames) {
  const fs::path file = out / table.file;
  {
    std::ofstream rows(beside(file), std::ios::binary | std::ios::trunc);
    rows << table.header;
    for (const ordered_json& frame : frames) rows << table.rows(frame);
    rows << std::flush;
    require(rows, beside(file));
  }
  fs::rename(beside(file), file);
}

void begin_list(const fs::path& file, const std::vector<ordered_json>& frames,
                const std::vector<LeftOutModel>& left_out) {
  {
    AppendJson list(beside(file), results_head(left_out), results_tail({}));
    for (const ordered_json& frame : frames) list.append(line(frame));
  }
  fs::rename(beside(file), file);
}

std::set<std::size_t> rewrite_results(const fs::path& out,
                                      const std::map<std::size_t, fs::path>& scans,
                                      const std::vector<LeftOutModel>& left_out,
                                      const std::vector<std::string>& formats) {
  const fs::path results = out / "results.json";
  const std::vector<ordered_json> frames = read_frames(results, "im_id").items;
  check_same_scans(results, frames, scans);
  for (const TableFormat& table : kTables)
    if (has(formats, table.format)) begin_table(out, table, frames);
  if (has(formats, "json")) begin_list(results, frames, left_out);
  begin_failures(out / "failures.json", scans);
  std::set<std::size_t> answered;
  for (const ordered_json& frame : frames) answered.insert(frame.at("frame").get<std::size_t>());
  return answered;
}

}  // namespace

std::set<std::size_t> begin_results(const fs::path& out, bool resume,
                                    const std::map<std::size_t, fs::path>& scans,
                                    const std::vector<LeftOutModel>& left_out,
                                    const std::vector<std::string>& formats) {
  check_begin(out, resume, formats);
  fs::create_directories(out);
  try {
    return rewrite_results(out, scans, left_out, formats);
  } catch (const ordered_json::exception& error) {
    throw std::runtime_error((out / "results.json").string() +
                             ": is not what a run wrote: " + reason_of(error));
  }
}

ResultsTable::ResultsTable(fs::path file, Rows rows)
    : file_(std::move(file)), stream_(file_, std::ios::binary | std::ios::app), rows_(rows) {}

void ResultsTable::append(const ordered_json& frame) {
  errno = 0;
  stream_ << rows_(frame) << std::flush;
  require(stream_, file_);
}

ResultsWriter::ResultsWriter(const fs::path& out, const std::vector<std::string>& formats)
    : failures_(out / "failures.json", kFailuresTail) {
  for (const TableFormat& table : kTables)
    if (has(formats, table.format)) tables_.emplace_back(out / table.file, table.rows);
  if (has(formats, "json")) results_.emplace(out / "results.json", results_tail({}));
}

void ResultsWriter::write(const FrameReport& frame, const Detections& detections,
                          const std::vector<graph::NodeTimes>& nodes) {
  const ordered_json json = to_json(frame, detections);
  for (ResultsTable& table : tables_) table.append(json);
  if (results_) results_->append(line(json), results_tail(nodes));
}

void ResultsWriter::write(const FailureReport& failure) {
  failures_.append(line({{"frame", failure.number},
                         {"file", failure.file.string()},
                         {"node", failure.node},
                         {"what", failure.what}}));
}

}  // namespace posevote::formats
