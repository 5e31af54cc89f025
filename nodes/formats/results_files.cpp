// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "graph/output_file.hpp"
#include "graph/parallel.hpp"
#include "graph/write_file.hpp"
#include "nodes/formats/json_text.hpp"
#include "nodes/formats/results_tables.hpp"
#include "nodes/formats/scan_hash.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kResults = "results.json";
constexpr const char* kFailures = "failures.json";

std::size_t number_of(const ordered_json& frame) { return frame.at("frame").get<std::size_t>(); }

std::string ids(int scene_id, int im_id) {
  return "scene_id " + std::to_string(scene_id) + ", im_id " + std::to_string(im_id);
}

}  // namespace

std::string difference(const ordered_json& frame, const SceneFile& scan) {
  const auto was = [](const std::string& before, const std::string& now) {
    return "was " + before + ", now it is " + now;
  };
  const fs::path before = frame.at("file").get<std::string>();
  const std::string name = line(before.filename().string());
  const std::string now = line(scan.path.filename().string());
  if (name != now) return was(name, now);
  const std::string numbers = ids(frame.at("scene_id").get<int>(), frame.at("im_id").get<int>());
  if (numbers != ids(scan.scene_id, scan.im_id))
    return before.string() + " " + was(numbers, ids(scan.scene_id, scan.im_id));
  if (frame.at("camera") != camera_json(scan.camera))
    return "the camera of " + scan.path.string() + " " +
           was(line(frame.at("camera")), line(camera_json(scan.camera)));
  return "";
}

namespace {

/// "" where it cannot be read.
std::vector<std::string> hash_scans(const std::vector<ordered_json>& frames,
                                    const std::map<std::size_t, SceneFile>& scans) {
  std::vector<std::string> hashes(frames.size());
  graph::parallel_for(frames.size(), 1, [&](std::size_t i) {
    hashes[i] = hash_or_unknown(scans.at(number_of(frames[i])));
  });
  return hashes;
}

[[noreturn]] void fail_changed(const fs::path& results, std::size_t frame, const std::string& how) {
  throw std::invalid_argument(results.string() + ": frame " + std::to_string(frame) + ": " + how +
                              ": the scans have changed; choose another --out");
}

}  // namespace

void check_same_scans(const fs::path& results, std::vector<ordered_json>& frames,
                      const std::map<std::size_t, SceneFile>& scans) {
  for (const ordered_json& frame : frames) {
    const auto scan = scans.find(number_of(frame));
    const std::string how =
        scan == scans.end() ? frame.at("file").get<std::string>() + " is not among them any more"
                            : difference(frame, scan->second);
    if (!how.empty()) fail_changed(results, number_of(frame), how);
  }
  const std::vector<std::string> now = hash_scans(frames, scans);
  std::vector<ordered_json> sure;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto before = frames[i].at("scan_hash").get<std::string>();
    if (before != now[i] && !before.empty())
      fail_changed(results, number_of(frames[i]),
                   scans.at(number_of(frames[i])).path.string() +
                       (now[i].empty() ? " cannot be read any more" : " holds something else now"));
    if (before == now[i]) sure.push_back(std::move(frames[i]));
  }
  frames = std::move(sure);
}

namespace {

/// In the order of the frames, each once.
void put_in_order(std::vector<ordered_json>& frames) {
  std::stable_sort(frames.begin(), frames.end(), [](const ordered_json& a, const ordered_json& b) {
    return number_of(a) < number_of(b);
  });
  const auto same = [](const ordered_json& a, const ordered_json& b) {
    return number_of(a) == number_of(b);
  };
  frames.erase(std::unique(frames.begin(), frames.end(), same), frames.end());
}

void write_table(const fs::path& out, const TableFormat& table,
                 const std::vector<ordered_json>& frames) {
  std::string text = table.header;
  for (const ordered_json& frame : frames) text += table.rows(frame);
  graph::write_durably(out / table.file, text);
}

void write_list(const fs::path& file, const std::string& head, const std::string& tail,
                const std::vector<ordered_json>& frames) {
  std::vector<std::string> items;
  for (const ordered_json& frame : frames) items.push_back(record(frame));
  graph::write_durably(file, json_list(head, items, tail));
}

void sync_all(const fs::path& out, const std::vector<std::string>& formats) {
  for (const TableFormat& table : kTables)
    if (has(formats, table.format)) graph::sync_file(out / table.file);
  if (has(formats, "json")) graph::sync_file(out / kResults);
  graph::sync_file(out / kFailures);
}

/// What a run wrote is as it wrote it; whatever else the JSON library finds is named by the file.
template <class Work>
auto on_results(const fs::path& out, const Work& work) {
  try {
    return work();
  } catch (const ordered_json::exception& error) {
    throw std::runtime_error((out / kResults).string() +
                             ": is not what a run wrote: " + reason_of(error));
  }
}

bool is_in_order(const fs::path& file) {
  const std::vector<std::size_t> numbers = frame_numbers(file);
  return std::is_sorted(numbers.begin(), numbers.end());
}

}  // namespace

std::vector<std::size_t> frame_numbers(const fs::path& file) {
  constexpr std::string_view kBegin = "{\"frame\":";
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::size_t> numbers;
  for (std::string text; std::getline(stream, text);)
    if (text.starts_with(kBegin) && (text.ends_with('}') || text.ends_with("},")))
      numbers.push_back(std::strtoull(text.c_str() + kBegin.size(), nullptr, 10));
  return numbers;
}

std::vector<graph::NodeTimes> read_node_times(const fs::path& file) {
  constexpr std::string_view kBegin = "\"nodes\": ";
  std::vector<graph::NodeTimes> nodes;
  std::ifstream stream(file, std::ios::binary);
  for (std::string text; std::getline(stream, text);) {
    if (!text.starts_with(kBegin) || !text.ends_with('}')) continue;
    text.pop_back();
    for (const ordered_json& node : parse_json<ordered_json>(text.substr(kBegin.size())))
      nodes.push_back({node.at("node").get<std::string>(), node.at("calls").get<std::uint64_t>(),
                       node.at("total_s").get<double>(), node.at("max_s").get<double>()});
  }
  return nodes;
}

void write_content(const fs::path& out, RunContent content,
                   const std::vector<std::string>& formats) {
  put_in_order(content.frames);
  put_in_order(content.failures);
  for (const TableFormat& table : kTables)
    if (has(formats, table.format)) write_table(out, table, content.frames);
  if (has(formats, "json"))
    write_list(out / kResults, results_head(content.left_out), results_tail(content.nodes),
               content.frames);
  write_list(out / kFailures, "[", kFailuresTail, content.failures);
}

void begin_results(const fs::path& out, const Batch& batch) {
  for (const char* file : {"results.csv", kResults, "detections.csv", kFailures})
    if (fs::exists(out / file))
      throw std::invalid_argument(
          out.string() +
          ": holds another run; choose another --out, or give --resume or --overwrite");
  fs::create_directories(out);
  write_content(out, {{}, {}, batch.left_out}, batch.formats);
}

Answered resume_results(const fs::path& out, const Batch& batch) {
  if (!has(batch.formats, "json"))
    throw std::invalid_argument(out.string() +
                                ": cannot be resumed without results.json, which says what is "
                                "answered; give --format json too, or --overwrite");
  fs::create_directories(out);
  return on_results(out, [&] {
    WrittenFrames frames = read_frames(out / kResults, "im_id", NoChecksum::kLeaveOut);
    WrittenFrames failures = read_frames(out / kFailures, "what", NoChecksum::kLeaveOut);
    const std::size_t read = frames.items.size();
    put_in_order(frames.items);
    check_same_scans(out / kResults, frames.items, batch.scans);
    Answered answered;
    answered.damaged = frames.torn + read - frames.items.size();
    for (const ordered_json& frame : frames.items) answered.frames.insert(number_of(frame));
    std::erase_if(failures.items, [&](const ordered_json& failure) {
      return batch.mine.contains(number_of(failure)) ||
             answered.frames.contains(number_of(failure));
    });
    write_content(out, {std::move(frames.items), std::move(failures.items), batch.left_out},
                  batch.formats);
    return answered;
  });
}

void finish_results(const fs::path& out, const std::vector<std::string>& formats) {
  const bool is_resumable = has(formats, "json");  // else no second start can have added any
  if (!is_resumable || (is_in_order(out / kResults) && is_in_order(out / kFailures)))
    return sync_all(out, formats);
  on_results(out, [&] {
    write_content(
        out,
        {read_frames(out / kResults, "im_id").items, read_frames(out / kFailures, "what").items,
         read_left_out(out / kResults), read_node_times(out / kResults)},
        formats);
  });
}

}  // namespace posevote::formats
