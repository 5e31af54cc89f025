// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/run_frames.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "graph/schema.hpp"
#include "nodes/formats/results_writer.hpp"

namespace posevote::explain {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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

std::vector<FrameOfRun> read_run_frames(const fs::path& out) {
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
