// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_json.hpp"

#include <fstream>
#include <stdexcept>
#include <utility>

#include "nodes/formats/json_text.hpp"
#include "nodes/geometry/rotation.hpp"
#include "nodes/library/content_hash.hpp"

namespace posevote::formats {
namespace {

using nlohmann::ordered_json;

const std::string kSum = ",\"checksum\":\"";
constexpr const char* kLeftOut = "\"models_left_out\": ";

std::vector<double> row_by_row(const Eigen::Isometry3d& T) {
  std::vector<double> matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix.push_back(T.matrix()(row, column));
  return matrix;
}

/// As in BOP's models_info.json, but in metres.
ordered_json to_json(const Symmetries& symmetries) {
  const Eigen::Vector3d about = symmetries.fixed_point.cast<double>();
  ordered_json discrete = ordered_json::array(), continuous = ordered_json::array();
  for (std::size_t i = 1; i < symmetries.turns.size(); ++i)
    discrete.push_back(
        row_by_row(geometry::turn_about(about, symmetries.turns[i].cast<double>().normalized())));
  for (const Eigen::Vector3f& axis : symmetries.axes)
    continuous.push_back(
        {{"axis", {axis.x(), axis.y(), axis.z()}}, {"offset", {about.x(), about.y(), about.z()}}});
  return {{"discrete", discrete}, {"continuous", continuous}};
}

ordered_json to_json(const std::vector<LookAlike>& others) {
  ordered_json list = ordered_json::array();
  for (const LookAlike& other : others)
    list.push_back({{"motion", row_by_row(other.motion)}, {"probability", other.probability}});
  return list;
}

/// Clues by their names.
ordered_json to_json(const Clues& values) {
  ordered_json clues;
  for (std::size_t i = 0; i < kClueCount; ++i) clues[kClueNames[i]] = values[i];
  return clues;
}

/// Row by row, or null.
ordered_json to_json(const std::optional<Eigen::Matrix<double, 6, 6>>& covariance) {
  if (!covariance) return nullptr;
  ordered_json list = ordered_json::array();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) list.push_back((*covariance)(row, column));
  return list;
}

ordered_json to_json(const Detection& found) {
  Eigen::Quaterniond q(found.T_scene_model.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();  // one text for one rotation
  const Eigen::Vector3d t = found.T_scene_model.translation();
  ordered_json json{{"obj_id", found.obj_id},
                    {"model", found.model},
                    {"confidence", found.confidence},
                    {"score", found.score},
                    {"density", found.density},
                    {"runner_up_density", found.runner_up_density},
                    {"inlier_fraction", found.inlier_fraction},
                    {"rmse_m", found.rmse},
                    {"clues", to_json(found.clues)},
                    {"against", to_json(found.against)},
                    {"T_scene_model", row_by_row(found.T_scene_model)},
                    {"q_wxyz", {q.w(), q.x(), q.y(), q.z()}},
                    {"t_m", {t.x(), t.y(), t.z()}},
                    {"covariance", to_json(found.covariance)},
                    {"seconds", found.seconds}};
  if (found.colors)
    json["colors"] = {{"likeness", found.colors->likeness}, {"tint", found.colors->tint}};
  if (found.why.empty())
    json["pose_confidence"] = found.pose_confidence();
  else
    json["why"] = found.why;
  if (found.symmetries.any()) json["symmetries"] = to_json(found.symmetries);
  if (!found.look_alikes.empty()) json["look_alikes"] = to_json(found.look_alikes);
  return json;
}

ordered_json to_json(const std::vector<Detection>& detections) {
  ordered_json list = ordered_json::array();
  for (const Detection& found : detections) list.push_back(to_json(found));
  return list;
}

/// What the numbers mean, for who has the file alone.
const ordered_json& about() {
  static const ordered_json text{
      {"format", "posevote results 1"},
      {"units", "m, rad, s"},
      {"T_scene_model",
       "4 x 4, row by row: takes a point of the model's file, in metres, to the scan's frame "
       "(p_scene = T p_model): of a depth image the camera's, x right, y down, z forward; of a "
       "point file the file's own"},
      {"q_wxyz, t_m", "the same as a unit quaternion and a translation"},
      {"covariance",
       "6 x 6, row by row, of the pose error xi = (translation [m], turn as a rotation vector "
       "[rad]), a twist in the model's frame, about its origin: T_true = T exp(xi); null of a pose "
       "that was not refined, or was no instance. A direction that nothing holds has a large "
       "variance"},
      {"symmetries", "motions of the model after which it looks the same: T S is as good as T"},
      {"look_alikes",
       "motions of the model to other poses that this scan does not tell from T for sure, because "
       "what differs is hidden or lost in noise: T motion may be right instead, and probability "
       "says how probably, given that the object lies there"},
      {"confidence",
       "the probability that the detection is right, one of its look_alikes counted as right"},
      {"pose_confidence",
       "the same, its look_alikes counted as wrong, and times the probability that it is no other "
       "object that fits there"},
      {"seconds",
       "of a frame: of the run's time its share; stages: of that, of each step. Of a detection: of "
       "segment_objects, the time spent on the search for this object, since its instance before"},
      {"latency_s",
       "of a frame: from when its scan was there (in a folder that is followed: complete; else: "
       "taken) until it was answered"},
      {"rejected", "the best poses that missed a threshold, and which"},
      {"colors",
       "where the scan and the model have any, what they say for a detection, in log odds: "
       "likeness, by how they vary over it; tint, by what they are on the mean (of a grey image "
       "what is neither for nor against)"},
      {"against",
       "what each clue takes from the confidence's log odds, beside what right "
       "detections usually have"}};
  return text;
}

}  // namespace

std::string line(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string record(const ordered_json& json) {
  std::string text = line(json);
  text.pop_back();  // }
  return text + kSum + library::checksum(text) + "\"}";
}

ordered_json camera_json(const std::optional<Camera>& camera) {
  if (!camera) return nullptr;
  return {{"fx", camera->fx},
          {"fy", camera->fy},
          {"cx", camera->cx},
          {"cy", camera->cy},
          {"depth_scale", camera->depth_scale}};
}

std::optional<Camera> camera_of(const ordered_json& json) {
  if (json.is_null()) return std::nullopt;
  const auto number = [&json](const char* key) { return json.at(key).get<double>(); };
  return Camera{number("fx"), number("fy"), number("cx"), number("cy"), number("depth_scale")};
}

ordered_json to_json(const FrameReport& frame, const Detections& detections) {
  ordered_json warnings = ordered_json::array();
  for (const graph::Warning& warning : frame.warnings)
    warnings.push_back({{"node", warning.node}, {"what", warning.what}});
  ordered_json json{{"frame", frame.number},
                    {"name", frame.name},
                    {"file", frame.file.path.string()},
                    {"scene_id", frame.file.scene_id},
                    {"im_id", frame.file.im_id},
                    {"camera", camera_json(frame.file.camera)},
                    {"scan_hash", frame.scan_hash},
                    {"seconds", frame.seconds},
                    {"stages", frame.stages}};
  for (const auto& [name, figure] : frame.figures)
    json[name] = figure.size() == 1 ? ordered_json(figure[0]) : ordered_json(figure);
  json["warnings"] = warnings;
  json["detections"] = to_json(detections.items);
  json["rejected"] = to_json(detections.rejected);
  return json;
}

std::string results_head(const std::vector<LeftOutModel>& left_out) {
  ordered_json list = ordered_json::array();
  for (const LeftOutModel& model : left_out)
    list.push_back({{"obj_id", model.obj_id}, {"model", model.name}, {"why", model.why}});
  return "{\"about\": " + line(about()) + ",\n" +
         (list.empty() ? "" : kLeftOut + line(list) + ",\n") + "\"frames\": [";
}

std::string results_tail(const std::vector<graph::NodeTimes>& nodes) {
  double sum = 0;
  for (const graph::NodeTimes& node : nodes) sum += node.total;
  ordered_json list = ordered_json::array();
  for (const graph::NodeTimes& node : nodes)
    list.push_back({{"node", node.node},
                    {"calls", node.calls},
                    {"total_s", node.total},
                    {"mean_s", node.mean()},
                    {"max_s", node.max},
                    {"share", sum > 0 ? node.total / sum : 0}});
  return "\n],\n\"nodes\": " + list.dump() + "}\n";
}

std::vector<LeftOutModel> read_left_out(const std::filesystem::path& file) {
  std::vector<LeftOutModel> left_out;
  std::ifstream stream(file);
  std::string text;
  while (std::getline(stream, text) && !text.starts_with(kLeftOut))
    if (text.starts_with("\"frames\"")) return left_out;
  if (!text.ends_with(',')) return left_out;
  text = "{" + text;
  text.back() = '}';
  try {
    const auto json = parse_json<ordered_json>(text);
    for (const ordered_json& model : json.at("models_left_out"))
      left_out.push_back({model.at("model").get<std::string>(), model.at("obj_id").get<int>(),
                          model.at("why").get<std::string>()});
  } catch (const std::exception&) {
    left_out.clear();  // torn
  }
  return left_out;
}

namespace {

/// Takes the checksum off a line. False where it is wrong, or is not there and must be.
bool check_sum(std::string& text, NoChecksum unsure) {
  const std::size_t length = kSum.size() + library::checksum("").size() + 2;  // "}
  if (text.size() <= length || text.compare(text.size() - length, kSum.size(), kSum) != 0)
    return unsure == NoChecksum::kTake;
  const std::string sum = text.substr(text.size() - length);
  text.resize(text.size() - length);
  if (sum != kSum + library::checksum(text) + "\"}") return false;
  text += '}';
  return true;
}

}  // namespace

WrittenFrames read_frames(const std::filesystem::path& file, const std::string& key,
                          NoChecksum unsure) {
  WrittenFrames frames;
  std::ifstream stream(file);
  for (std::string text; std::getline(stream, text);) {
    if (!text.starts_with("{\"frame\"")) continue;
    if (text.ends_with(',')) text.pop_back();
    try {
      auto frame = check_sum(text, unsure) ? parse_json<ordered_json>(text) : ordered_json();
      if (frame.contains(key))
        frames.items.push_back(std::move(frame));
      else
        ++frames.torn;
    } catch (const std::runtime_error&) {
      ++frames.torn;
    }
  }
  return frames;
}

}  // namespace posevote::formats
