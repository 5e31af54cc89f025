// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/run_inputs.hpp"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "graph/schema.hpp"
#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/results_writer.hpp"
#include "tools/run_record.hpp"

namespace posevote::explain {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// As seen from here, of a path that was typed in `folder`.
std::string from(const std::string& folder, const std::string& path) {
  return path.empty() ? "" : (fs::path(folder) / path).lexically_normal().string();
}

/// "# posevote run --seed 7; models ..." begins effective.yaml.
std::uint64_t read_seed(const fs::path& file) {
  const std::string mark = "--seed ";
  const formats::FileBytes yaml = formats::read_file(file);
  const std::string first(yaml.view().substr(0, yaml.view().find('\n')));
  const std::size_t at = first.find(mark);
  return at == std::string::npos ? 0 : std::strtoull(first.c_str() + at + mark.size(), nullptr, 10);
}

/// The value of an option among the words that were typed.
std::string option_of(const std::vector<std::string>& words, const std::string& name) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == name && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with(name + "=")) return words[i].substr(name.size() + 1);
  }
  return "";
}

template <class T>
T value_or(const Json& json, const char* key, T otherwise) {
  const auto at = json.find(key);
  return at == json.end() ? otherwise : at->get<T>();
}

void add_answered(const fs::path& out, std::vector<FrameOfRun>& frames) {
  for (const Json& json : formats::read_frames(out / "results.json", "detections").items)
    frames.push_back({value_or<std::size_t>(json, "frame", 0),
                      value_or<std::string>(json, "name", ""),
                      value_or<std::string>(json, "file", ""), value_or(json, "scene_id", 0),
                      value_or(json, "im_id", 0), "", ""});
}

void add_failed(const fs::path& out, std::vector<FrameOfRun>& frames) {
  for (const Json& json : formats::read_frames(out / "failures.json", "what").items) {
    FrameOfRun frame;
    frame.number = value_or<std::size_t>(json, "frame", 0);
    frame.file = value_or<std::string>(json, "file", "");
    frame.name = frame.file.stem().string();
    frame.failed_node = value_or<std::string>(json, "node", "");
    frame.failure = value_or<std::string>(json, "what", "");
    frames.push_back(std::move(frame));
  }
}

bool is_called(const FrameOfRun& frame, const std::string& scene) {
  return frame.name == scene || frame.file == scene || frame.file.filename() == scene ||
         frame.file.stem() == scene || std::to_string(frame.number) == scene ||
         std::to_string(frame.scene_id) + "/" + std::to_string(frame.im_id) == scene;
}

/// How exactly a name is meant: the name of a frame goes before a file's that others share.
const FrameOfRun* exactly(const std::vector<FrameOfRun>& frames, const std::string& scene) {
  for (const FrameOfRun& frame : frames)
    if (frame.name == scene || frame.file == scene) return &frame;
  return nullptr;
}

}  // namespace

RunInputs read_inputs(const fs::path& out) {
  RunInputs inputs;
  inputs.seed = read_seed(out / "effective.yaml");
  const std::vector<RunRecord> records = read_run_records(out);
  if (records.empty()) return inputs;
  const RunRecord& last = records.back();
  inputs.folder = last.folder;
  inputs.dataset = from(last.folder, last.dataset);
  if (!last.split.empty()) inputs.split = last.split;
  inputs.library = from(last.folder, last.library);
  inputs.cache = from(last.folder, option_of(last.command, "--cache"));
  for (const SoughtModel& model : last.models)
    if (!model.file.empty()) inputs.models.push_back(from(last.folder, model.file));
  return inputs;
}

std::vector<FrameOfRun> read_run_frames(const fs::path& out) {
  if (!fs::exists(out / "effective.yaml"))
    throw std::invalid_argument((out / "effective.yaml").string() +
                                ": not there; expected the --out folder of a `posevote run`");
  std::vector<FrameOfRun> frames;
  try {
    add_answered(out, frames);
    add_failed(out, frames);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument((out / "results.json").string() + ": " + error.what());
  }
  if (frames.empty())
    throw std::invalid_argument(out.string() + ": the run has answered no scan, nor failed at any");
  return frames;
}

const FrameOfRun& find_frame(const std::vector<FrameOfRun>& frames, const std::string& scene,
                             const fs::path& out) {
  if (const FrameOfRun* frame = exactly(frames, scene)) return *frame;
  const FrameOfRun* found = nullptr;
  std::vector<std::string> names;
  for (const FrameOfRun& frame : frames) {
    names.push_back(frame.name);
    if (!is_called(frame, scene)) continue;
    if (found)
      throw std::invalid_argument("--scene " + scene + ": may be " + found->name + " or " +
                                  frame.name + " of " + out.string());
    found = &frame;
  }
  if (found) return *found;
  const std::string near = graph::closest_name(scene, names);
  throw std::invalid_argument("--scene " + scene + ": no such scan in " + out.string() +
                              (near.empty() ? ", which has " + std::to_string(frames.size()) +
                                                  ", from " + names.front() + " to " + names.back()
                                            : ", did you mean '" + near + "'?"));
}

}  // namespace posevote::explain
