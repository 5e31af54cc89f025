// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sweep/journal.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "graph/output_file.hpp"
#include "graph/write_file.hpp"
#include "nodes/formats/json_text.hpp"
#include "nodes/formats/results_files.hpp"
#include "nodes/formats/scan_hash.hpp"

namespace posevote::sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kTail = "\n]\n";

Json to_json(const Answer::Pose& pose) {
  Json numbers = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      numbers.push_back(pose.T_scene_model.matrix()(row, column));
  return {{"obj_id", pose.obj_id}, {"score", pose.score}, {"T_scene_model", numbers}};
}

Answer::Pose to_pose(const Json& json) {
  Answer::Pose pose{json.at("obj_id").get<int>(), json.at("score").get<double>(),
                    Eigen::Isometry3d::Identity()};
  const Json& numbers = json.at("T_scene_model");
  for (int i = 0; i < 12; ++i)
    pose.T_scene_model.matrix()(i / 4, i % 4) =
        numbers.at(static_cast<std::size_t>(i)).get<double>();
  return pose;
}

Json to_json(const Answer& answer) {
  Json json{{"seconds", answer.seconds}, {"found", Json::array()}};
  if (answer.failure) json["failure"] = *answer.failure;
  for (const Answer::Pose& pose : answer.found) json["found"].push_back(to_json(pose));
  return json;
}

Answer to_answer(const Json& json) {
  Answer answer;
  answer.seconds = json.at("seconds").get<double>();
  if (json.contains("failure")) answer.failure = json.at("failure").get<std::string>();
  for (const Json& pose : json.at("found")) answer.found.push_back(to_pose(pose));
  return answer;
}

Json to_json(const SceneEntry& scan, const ScanAnswers& answers) {
  Json json{{"frame", scan.number},
            {"name", scan.name},
            {"file", scan.file.path.string()},
            {"scene_id", scan.file.scene_id},
            {"im_id", scan.file.im_id},
            {"camera", formats::camera_json(scan.file.camera)},
            {"scan_hash", formats::hash_or_unknown(scan.file)},  // unknown: it is searched again
            {"settings", Json::array()},
            {"calls", Json::object()}};
  for (const Answer& answer : answers.settings) json["settings"].push_back(to_json(answer));
  for (const auto& [node, calls] : answers.calls) json["calls"][node] = {calls.asked, calls.made};
  return json;
}

ScanAnswers to_answers(const Json& json) {
  ScanAnswers answers;
  for (const Json& answer : json.at("settings")) answers.settings.push_back(to_answer(answer));
  for (const auto& [node, calls] : json.at("calls").items())
    answers.calls[node] = {calls.at(0).get<std::size_t>(), calls.at(1).get<std::size_t>()};
  return answers;
}

bool has_failed(const ScanAnswers& answers) {
  return std::any_of(answers.settings.begin(), answers.settings.end(),
                     [](const Answer& answer) { return answer.failure.has_value(); });
}

/// Those of scans that hold what they held.
std::vector<Json> read_records(const fs::path& file, const std::vector<SceneEntry>& scans) {
  std::vector<Json> records =
      formats::read_frames(file, "settings", formats::NoChecksum::kLeaveOut).items;
  std::map<std::size_t, SceneFile> files;
  for (const SceneEntry& scan : scans) files[scan.number] = scan.file;
  formats::check_same_scans(file, records, files);
  return records;
}

}  // namespace

Journal::Journal(const fs::path& out, bool resume, const std::vector<SceneEntry>& scans)
    : file_(out / "scans.json") {
  std::vector<std::string> lines;
  try {
    if (resume)
      for (const Json& record : read_records(file_, scans)) {
        ScanAnswers answers = to_answers(record);
        if (has_failed(answers)) continue;
        known_[record.at("frame").get<std::size_t>()] = std::move(answers);
        lines.push_back(formats::record(record));
      }
  } catch (const Json::exception& error) {
    throw std::runtime_error(file_.string() +
                             ": is not what a sweep wrote: " + formats::reason_of(error));
  }
  graph::write_durably(file_, formats::json_list("[", lines, kTail));
  list_.emplace(file_, kTail);
}

const ScanAnswers* Journal::find(std::size_t scan) const {
  const auto found = known_.find(scan);
  return found == known_.end() ? nullptr : &found->second;
}

const ScanAnswers& Journal::add(const SceneEntry& scan, ScanAnswers answers) {
  list_->append(formats::record(to_json(scan, answers)));
  graph::sync_file(file_);
  return known_[scan.number] = std::move(answers);
}

}  // namespace posevote::sweep
