// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_writer.hpp"

#include <cerrno>
#include <cstdio>
#include <stdexcept>

#include "graph/write_file.hpp"
#include "nodes/formats/json_text.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kHeader = "scene_id,im_id,obj_id,score,R,t,time\n";
constexpr const char* kLeftOut = "\"models_left_out\": ";
constexpr const char* kFailuresTail = "\n]\n";

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

/// One line; names that are not UTF-8 (paths may be anything) are mended, not thrown at.
std::string line(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

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
        row_by_row(Eigen::Translation3d(about) * symmetries.turns[i].cast<double>().normalized() *
                   Eigen::Translation3d(-about)));
  for (const Eigen::Vector3f& axis : symmetries.axes)
    continuous.push_back(
        {{"axis", {axis.x(), axis.y(), axis.z()}}, {"offset", {about.x(), about.y(), about.z()}}});
  return {{"discrete", discrete}, {"continuous", continuous}};
}

/// Clues by their names.
ordered_json to_json(const Clues& values) {
  ordered_json clues;
  for (std::size_t i = 0; i < kClueCount; ++i) clues[kClueNames[i]] = values[i];
  return clues;
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
                    {"t_m", {t.x(), t.y(), t.z()}}};
  if (!found.why.empty()) json["why"] = found.why;
  if (found.symmetries.any()) json["symmetries"] = to_json(found.symmetries);
  return json;
}

ordered_json to_json(const std::vector<Detection>& detections) {
  ordered_json list = ordered_json::array();
  for (const Detection& found : detections) list.push_back(to_json(found));
  return list;
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
                    {"seconds", frame.seconds},
                    {"stages", frame.stages}};
  for (const auto& [name, figure] : frame.figures)
    json[name] = figure.size() == 1 ? ordered_json(figure[0]) : ordered_json(figure);
  json["warnings"] = warnings;
  json["detections"] = to_json(detections.items);
  json["rejected"] = to_json(detections.rejected);
  return json;
}

/// Rows of results.csv from a line of results.json, which holds all of them: a killed run may have
/// written half a row.
std::string csv_rows(const ordered_json& json) {
  FrameReport frame;
  frame.file.scene_id = json.at("scene_id").get<int>();
  frame.file.im_id = json.at("im_id").get<int>();
  frame.seconds = json.at("seconds").get<double>();
  Detections detections;
  for (const ordered_json& item : json.at("detections")) {
    Detection& found = detections.items.emplace_back();
    found.obj_id = item.at("obj_id").get<int>();
    found.confidence = item.at("confidence").get<double>();
    for (int i = 0; i < 16; ++i)
      found.T_scene_model.matrix()(i / 4, i % 4) = item.at("T_scene_model").at(i).get<double>();
  }
  return csv_rows(frame, detections);
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
      {"symmetries", "motions of the model after which it looks the same: T S is as good as T"},
      {"confidence", "the probability that the detection is right"},
      {"rejected", "the best poses that missed a threshold, and which"},
      {"against",
       "what each clue takes from the confidence's log odds, beside what right "
       "detections usually have"}};
  return text;
}

/// Lines for what the numbers mean and for the models that are left out, if there are any, and the
/// beginning of the list.
std::string results_head(const std::vector<LeftOutModel>& left_out) {
  ordered_json list = ordered_json::array();
  for (const LeftOutModel& model : left_out)
    list.push_back({{"obj_id", model.obj_id}, {"model", model.name}, {"why", model.why}});
  return "{\"about\": " + line(about()) + ",\n" +
         (list.empty() ? "" : kLeftOut + line(list) + ",\n") + "\"frames\": [";
}

[[noreturn]] void fail_changed(const fs::path& results, std::size_t frame,
                               const std::string& before, const std::string& now) {
  throw std::invalid_argument(results.string() + ": frame " + std::to_string(frame) + " is " +
                              before + " there, now it is " + now +
                              ": the scans have changed; choose another --out");
}

/// Names only: the same scans may be reached by another path.
void check_same_scans(const fs::path& results, const std::vector<ordered_json>& frames,
                      const std::map<std::size_t, fs::path>& scans) {
  for (const ordered_json& frame : frames) {
    const auto scan = scans.find(frame.at("frame").get<std::size_t>());
    if (scan == scans.end()) continue;
    const std::string before = fs::path(frame.at("file").get<std::string>()).filename().string();
    const std::string now = scan->second.filename().string();
    if (line(now) != line(before)) fail_changed(results, scan->first, before, now);
  }
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

/// Old results are rewritten beside the old files, so that a crash here loses none of them.
std::set<std::size_t> rewrite_results(const fs::path& out,
                                      const std::map<std::size_t, fs::path>& scans,
                                      const std::vector<LeftOutModel>& left_out) {
  const fs::path csv = out / "results.csv", results = out / "results.json";
  const std::vector<ordered_json> frames = read_frames(results, "im_id").items;
  check_same_scans(results, frames, scans);
  const fs::path new_csv = out / "results.csv.new";
  const fs::path new_results = out / "results.json.new";
  std::set<std::size_t> answered;
  {
    std::ofstream rows(new_csv, std::ios::binary | std::ios::trunc);
    AppendJson list(new_results, results_head(left_out), results_tail({}));
    rows << kHeader;
    for (const ordered_json& frame : frames) {
      rows << csv_rows(frame);
      list.append(line(frame));
      answered.insert(frame.at("frame").get<std::size_t>());
    }
    rows << std::flush;
    require(rows, new_csv);
  }
  fs::rename(new_csv, csv);
  fs::rename(new_results, results);
  begin_failures(out / "failures.json", scans);
  return answered;
}

}  // namespace

std::set<std::size_t> begin_results(const fs::path& out, bool resume,
                                    const std::map<std::size_t, fs::path>& scans,
                                    const std::vector<LeftOutModel>& left_out) {
  const fs::path csv = out / "results.csv";
  const fs::path results = out / "results.json";
  if (!resume && (fs::exists(csv) || fs::exists(results)))
    throw std::invalid_argument(
        out.string() +
        ": holds another run; choose another --out, or give --resume or --overwrite");
  fs::create_directories(out);
  try {
    return rewrite_results(out, scans, left_out);
  } catch (const ordered_json::exception& error) {
    throw std::runtime_error(results.string() + ": is not what a run wrote: " + reason_of(error));
  }
}

ResultsWriter::ResultsWriter(const fs::path& out)
    : csv_file_(out / "results.csv"),
      csv_(csv_file_, std::ios::binary | std::ios::app),
      results_(out / "results.json", results_tail({})),
      failures_(out / "failures.json", kFailuresTail) {}

void ResultsWriter::write(const FrameReport& frame, const Detections& detections,
                          const std::vector<graph::NodeTimes>& nodes) {
  errno = 0;
  csv_ << csv_rows(frame, detections) << std::flush;
  require(csv_, csv_file_);
  results_.append(line(to_json(frame, detections)), results_tail(nodes));
}

void ResultsWriter::write(const FailureReport& failure) {
  failures_.append(line({{"frame", failure.number},
                         {"file", failure.file.string()},
                         {"node", failure.node},
                         {"what", failure.what}}));
}

std::vector<LeftOutModel> read_left_out(const fs::path& file) {
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

WrittenFrames read_frames(const fs::path& file, const std::string& key) {
  WrittenFrames frames;
  std::ifstream stream(file);
  for (std::string text; std::getline(stream, text);) {
    if (!text.starts_with("{\"frame\"")) continue;
    if (text.ends_with(',')) text.pop_back();
    try {
      auto frame = parse_json<ordered_json>(text);
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

std::string csv_rows(const FrameReport& frame, const Detections& detections) {
  std::string rows;
  char text[512];
  for (const Detection& found : detections.items) {
    const Eigen::Matrix3d r = found.T_scene_model.linear();
    const Eigen::Vector3d t = found.T_scene_model.translation() * 1e3;
    std::snprintf(
        text, sizeof text,
        "%d,%d,%d,%.6f,%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g,%.6f %.6f %.6f,%.3f\n",
        frame.file.scene_id, frame.file.im_id, found.obj_id, found.confidence, r(0, 0), r(0, 1),
        r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2), t.x(), t.y(), t.z(),
        frame.seconds);
    rows += text;
  }
  return rows;
}

}  // namespace posevote::formats
