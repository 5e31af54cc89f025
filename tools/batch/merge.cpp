// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>
#include <map>
#include <stdexcept>
#include <utility>

#include "graph/write_file.hpp"
#include "nodes/formats/results_files.hpp"
#include "nodes/formats/results_tables.hpp"
#include "tools/batch/batch.hpp"
#include "tools/json_answer.hpp"
#include "tools/manifest/run_folder.hpp"
#include "tools/run_lock.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using formats::NoChecksum;
using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const fs::path& part, const std::string& why) {
  throw std::invalid_argument(part.string() + ": " + why);
}

/// The parts' manifests, their frames, and which part each frame is of.
class Merged {
 public:
  explicit Merged(const std::vector<fs::path>& parts) {
    for (const fs::path& part : parts) add(part);
    check_complete();
    // The paths of the scans are from the folder of the last start.
    std::rotate(run_.starts.begin(), run_.starts.begin() + std::ptrdiff_t(first_starts_),
                run_.starts.end());
  }

  const Manifest& run() const { return run_; }
  const formats::RunContent& content() const { return content_; }

 private:
  void add(const fs::path& part) {
    if (lock_holder(part)) refuse(part, "a run is writing there");
    const std::optional<Manifest> manifest = read_manifest(part);
    if (!manifest) refuse(part, "no run.json in it; expected the --out folder of a `posevote run`");
    if (parts_.empty()) {
      run_ = *manifest;
      first_starts_ = run_.starts.size();
      content_.left_out = formats::read_left_out(part / "results.json");
    } else {
      check_same_run(part, *manifest);
      run_.starts.insert(run_.starts.end(), manifest->starts.begin(), manifest->starts.end());
    }
    parts_.push_back(part);
    take(part, "results.json", "im_id", content_.frames);
    take(part, "failures.json", "what", content_.failures);
    add_times(formats::read_node_times(part / "results.json"));
  }

  void check_same_run(const fs::path& part, const Manifest& other) const {
    const std::vector<std::string> all = differences(run_, other);
    if (!all.empty())
      refuse(part, "is of another run than " + parts_.front().string() + ": " + all.front());
    if (other.scans.size() != run_.scans.size())
      refuse(part, "is of a batch of " + std::to_string(other.scans.size()) + " scans, " +
                       parts_.front().string() + " of " + std::to_string(run_.scans.size()));
    for (std::size_t i = 0; i < other.scans.size(); ++i) {
      const std::string how = formats::difference(record_of(run_.scans[i]), other.scans[i].file);
      if (!how.empty())
        refuse(part, "is of another batch than " + parts_.front().string() + ": frame " +
                         std::to_string(i) + ": " + how);
    }
  }

  static Json record_of(const SceneEntry& scan) {
    return {{"file", scan.file.path.string()},
            {"scene_id", scan.file.scene_id},
            {"im_id", scan.file.im_id},
            {"camera", formats::camera_json(scan.file.camera)}};
  }

  void take(const fs::path& part, const std::string& name, const std::string& key,
            std::vector<Json>& all) {
    formats::WrittenFrames frames = formats::read_frames(part / name, key, NoChecksum::kLeaveOut);
    if (frames.torn > 0)
      refuse(part / name, std::to_string(frames.torn) +
                              " damaged records; `posevote run --resume` does their frames again");
    for (Json& frame : frames.items) {
      const auto number = frame.at("frame").get<std::size_t>();
      if (number >= run_.scans.size())
        refuse(part / name, "frame " + std::to_string(number) + " is none of the batch's " +
                                std::to_string(run_.scans.size()));
      const auto [first, is_new] = owners_.emplace(number, part);
      if (!is_new)
        refuse(part / name, "frame " + std::to_string(number) + " (" + run_.scans[number].name +
                                ") is in " + first->second.string() + ", too");
      all.push_back(std::move(frame));
    }
  }

  void add_times(const std::vector<graph::NodeTimes>& nodes) {
    for (const graph::NodeTimes& node : nodes) {
      const auto same =
          std::find_if(content_.nodes.begin(), content_.nodes.end(),
                       [&node](const auto& other) { return other.node == node.node; });
      if (same == content_.nodes.end()) {
        content_.nodes.push_back(node);
        continue;
      }
      same->calls += node.calls;
      same->total += node.total;
      same->max = std::max(same->max, node.max);
    }
  }

  void check_complete() const {
    constexpr std::size_t kShown = 5;
    std::string names;
    std::size_t missing = 0;
    for (const SceneEntry& scan : run_.scans)
      if (!owners_.contains(scan.number) && ++missing <= kShown)
        names += (missing > 1 ? ", " : "") + std::to_string(scan.number) + " (" + scan.name + ")";
    if (missing > 0)
      throw std::invalid_argument(
          std::to_string(missing) + " of " + std::to_string(run_.scans.size()) +
          " frames are in none of the folders: " + names + (missing > kShown ? " ..." : "") +
          "; a shard is missing or has not ended");
  }

  std::vector<fs::path> parts_;
  Manifest run_;
  std::size_t first_starts_ = 0;
  formats::RunContent content_;
  std::map<std::size_t, fs::path> owners_;
};

/// Pictures and the like, a few files for each frame; links where the file system has them.
void gather(const fs::path& from, const fs::path& to) {
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(from, none)) {
    const fs::path place = to / entry.path().lexically_relative(from);
    if (entry.is_directory()) {
      fs::create_directories(place);
      continue;
    }
    fs::create_directories(place.parent_path());
    std::error_code problem;
    fs::create_hard_link(entry.path(), place, problem);
    if (problem) fs::copy_file(entry.path(), place, fs::copy_options::overwrite_existing);
  }
}

std::vector<std::string> formats_in(const fs::path& part) {
  std::vector<std::string> formats{"json"};
  for (const formats::TableFormat& table : formats::kTables)
    if (fs::exists(part / table.file)) formats.emplace_back(table.format);
  return formats;
}

}  // namespace

RunStatus merge(const std::vector<fs::path>& parts, const fs::path& out, bool overwrite) {
  for (const fs::path& part : parts) {
    std::error_code none;
    if (fs::equivalent(part, out, none)) refuse(out, "is one of the parts; choose another --out");
  }
  const Merged merged(parts);
  const RunLock lock(out);
  if (overwrite) remove_run(out);
  const std::vector<std::string> formats = formats_in(parts.front());
  formats::begin_results(out, {{}, {}, merged.content().left_out, formats});
  for (const fs::path& part : parts)
    for (const char* folder : kFoldersOfFrames) gather(part / folder, out / folder);
  fs::copy_file(parts.front() / "effective.yaml", out / "effective.yaml",
                fs::copy_options::overwrite_existing);
  write_manifest(out, merged.run());
  formats::write_content(out, merged.content(), formats);
  return read_status(out);
}

int merge_command(const MergeCommand& command) {
  const JsonAnswer answer(command.json);
  const std::vector<fs::path> parts(command.parts.begin(), command.parts.end());
  const RunStatus status = as_arguments([&] {
    try {
      return merge(parts, command.out, command.overwrite);
    } catch (const Json::exception& error) {
      throw std::invalid_argument(std::string("a record is not what a run wrote: ") + error.what());
    }
  });
  std::cout << status.done << " frames answered, " << status.failed << " failed; merged into "
            << printable(command.out) << "\n"
            << std::flush;
  answer.give({{"answered", status.done}, {"failed", status.failed}, {"out", command.out}});
  return 0;
}

}  // namespace posevote
