// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>

#include "nodes/formats/json_text.hpp"
#include "nodes/formats/results_files.hpp"
#include "tools/batch/batch.hpp"
#include "tools/json_answer.hpp"
#include "tools/manifest/manifest.hpp"
#include "tools/run_lock.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Frames = std::set<std::size_t>;

Frames frames_in(const fs::path& file) {
  const std::vector<std::size_t> numbers = formats::frame_numbers(file);
  return {numbers.begin(), numbers.end()};
}

/// Those that have left the run; of one that writes tables alone, which do not name a frame in which
/// nothing is found.
Frames frames_in_trace(const fs::path& out, const Manifest& run) {
  std::map<std::string, std::size_t> numbers;
  for (const SceneEntry& scan : run.scans) numbers[scan.name] = scan.number;
  Frames frames;
  std::ifstream stream(out / "trace.json", std::ios::binary);
  for (std::string line; std::getline(stream, line);) try {
      if (line.ends_with(',')) line.pop_back();
      const auto event = formats::parse_json<nlohmann::json>(line);
      const auto frame = numbers.find(event.at("args").at("frame").get<std::string>());
      if (frame != numbers.end()) frames.insert(frame->second);
    } catch (const std::exception&) {  // no event: the list's ends, what a killed run has torn
    }
  return frames;
}

Frames answered_frames(const fs::path& out, const Manifest& run) {
  for (const char* file : kAnswerFiles)
    if (fs::exists(out / file)) return frames_in(out / file);
  Frames frames = frames_in_trace(out, run);
  for (const std::size_t failed : frames_in(out / "failures.json")) frames.erase(failed);
  return frames;
}

/// Frames that the starts of a run were to answer.
Frames asked_for(const Manifest& run) {
  Frames asked;
  for (const RunStart& start : run.starts)
    for (const SceneEntry& scene : take_shard(run.scans, start.shard)) asked.insert(scene.number);
  return asked;
}

double seconds_since_1970(std::chrono::system_clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

/// When a file was last written; 0 where it is not there.
double written_at(const fs::path& file) {
  std::error_code none;
  const auto time = fs::last_write_time(file, none);
  return none
             ? 0
             : seconds_since_1970(std::chrono::time_point_cast<std::chrono::system_clock::duration>(
                   std::chrono::file_clock::to_sys(time)));
}

double rate_of(const RunStatus& status, const RunStart& start) {
  const std::size_t since = status.done + status.failed - std::min(start.answered, status.done);
  double until = status.is_running ? seconds_since_1970(std::chrono::system_clock::now()) : 0;
  for (const char* file : {"results.json", "scans.json", "trace.json", "failures.json"})
    until = std::max(until, written_at(status.out / file));
  return until > start.time ? static_cast<double>(since) / (until - start.time) : 0;
}

std::string state_of(const RunStatus& status) {
  if (status.is_running) return "running";
  return status.left > 0 ? "stopped" : "done";
}

std::string line_of(const RunStatus& status) {
  std::string text = format("%-8s %7zu answered %6zu failed %7zu left", state_of(status).c_str(),
                            status.done, status.failed, status.left);
  if (status.rate > 0) text += format("  %6.2f frames/s", status.rate);
  if (status.is_running && status.rate > 0 && status.left > 0)
    text += "  " + duration_text(static_cast<double>(status.left) / status.rate) + " to go";
  text += "  " + printable(status.out.string());
  if (status.is_running)
    text += "  by process " + std::to_string(status.process) + " on " + status.host;
  return text + "\n";
}

nlohmann::ordered_json json_of(const RunStatus& status) {
  return {{"out", status.out.string()}, {"state", state_of(status)}, {"answered", status.done},
          {"failed", status.failed},    {"left", status.left},       {"frames_per_s", status.rate},
          {"host", status.host},        {"process", status.process}};
}

}  // namespace

RunStatus read_status(const fs::path& out) {
  const std::optional<Manifest> run = read_manifest(out);
  if (!run || run->starts.empty())
    throw std::invalid_argument(
        out.string() + ": no run.json in it; expected the --out folder of a `posevote run`");
  const RunStart& start = run->starts.back();
  const Frames done = answered_frames(out, *run);
  Frames failed = frames_in(out / "failures.json");
  std::erase_if(failed, [&done](std::size_t frame) { return done.contains(frame); });
  RunStatus status;
  status.out = out;
  status.done = done.size();
  status.failed = failed.size();
  for (const std::size_t frame : asked_for(*run))
    status.left += !done.contains(frame) && !failed.contains(frame);
  const std::optional<int> holder = lock_holder(out);
  status.is_running = holder.has_value();
  status.host = start.host;
  status.process = holder.value_or(0) != 0 ? *holder : start.process;
  status.rate = rate_of(status, start);
  return status;
}

int status_command(const StatusCommand& command) {
  const JsonAnswer answer(command.json);
  RunStatus all;
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  std::string lines;
  for (const std::string& out : command.out) {
    const RunStatus status = as_arguments([&out] { return read_status(out); });
    all.done += status.done;
    all.failed += status.failed;
    all.left += status.left;
    lines += line_of(status);
    runs.push_back(json_of(status));
  }
  if (command.out.size() > 1)
    lines +=
        format("%-8s %7zu answered %6zu failed %7zu left\n", "all", all.done, all.failed, all.left);
  if (!command.json) std::cout << lines << std::flush;
  answer.give({{"runs", runs}, {"answered", all.done}, {"failed", all.failed}, {"left", all.left}});
  return 0;
}

}  // namespace posevote
