// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/results_json.hpp"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <tuple>

#include "nodes/formats/results_writer.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kSamePose = 1e-6;  // what a CSV rounds away, in m and of a matrix

void add_beliefs(FoundInstance& row, const std::vector<const FoundInstance*>& others) {
  for (const FoundInstance* other : others) {
    if (!row.T_scene_model.isApprox(other->T_scene_model, kSamePose)) continue;
    row.covariance = other->covariance;
    row.pose_confidence = other->pose_confidence;
  }
}

/// What of a results.json is not in the CSV beside it.
void add_beliefs(std::vector<FoundInstance>& rows, const std::vector<FoundInstance>& found) {
  std::map<std::tuple<int, int, int>, std::vector<const FoundInstance*>> by_key;
  for (const FoundInstance& one : found)
    by_key[{one.scene_id, one.im_id, one.obj_id}].push_back(&one);
  for (FoundInstance& row : rows) add_beliefs(row, by_key[{row.scene_id, row.im_id, row.obj_id}]);
}

}  // namespace

FoundInstance found_instance(const Json& frame, const Json& detection) {
  FoundInstance found;
  found.scene_id = frame.at("scene_id").get<int>();
  found.im_id = frame.at("im_id").get<int>();
  found.obj_id = detection.at("obj_id").get<int>();
  found.score = detection.at("confidence").get<double>();
  for (int i = 0; i < 16; ++i)
    found.T_scene_model.matrix()(i / 4, i % 4) = detection.at("T_scene_model").at(i).get<double>();
  if (detection.contains("pose_confidence"))
    found.pose_confidence = detection.at("pose_confidence").get<double>();
  const auto covariance = detection.find("covariance");
  if (covariance == detection.end() || covariance->is_null()) return found;
  found.covariance.emplace();
  for (int i = 0; i < 36; ++i) (*found.covariance)(i / 6, i % 6) = covariance->at(i).get<double>();
  return found;
}

std::vector<FoundInstance> read_results_json(const std::string& file) {
  if (!fs::is_regular_file(file))
    throw std::runtime_error(file + ": cannot be read: no such file?");
  std::vector<FoundInstance> all;
  try {
    const formats::WrittenFrames frames = formats::read_frames(file, "detections");
    if (frames.torn > 0)
      throw std::runtime_error(file + ": " + std::to_string(frames.torn) +
                               " damaged records; `posevote run --resume` does their frames again");
    for (const Json& frame : frames.items)
      for (const Json& detection : frame.at("detections")) {
        all.push_back(found_instance(frame, detection));
        all.back().line = static_cast<int>(all.size());
      }
  } catch (const Json::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  return all;
}

std::vector<FoundInstance> read_results(const std::string& file) {
  if (fs::path(file).extension() == ".json") return read_results_json(file);
  std::vector<FoundInstance> rows = read_results_csv(file);
  const fs::path beside = fs::path(file).replace_extension(".json");
  if (fs::is_regular_file(beside)) add_beliefs(rows, read_results_json(beside.string()));
  return rows;
}

}  // namespace posevote
