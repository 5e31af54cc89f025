// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/run_data.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "graph/parallel.hpp"
#include "pipelines/library.hpp"
#include "tools/explain/explain.hpp"
#include "tools/report/html.hpp"
#include "tools/report/model_list.hpp"
#include "tools/report/shown_scan.hpp"
#include "tools/symmetry_report.hpp"

namespace posevote::page {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRejected = 4;  // of a scan

bool is_wanted(const std::string& name, const RunView& view) {
  return view.scans.empty() ||
         std::find(view.scans.begin(), view.scans.end(), name) != view.scans.end();
}

std::string name_of(const FailedFrame& failure) {
  return std::filesystem::path(failure.file).stem().string();
}

/// Short: a tenth of a micrometre is enough to look at.
Json rounded(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e7) / 1e7) : Json();
}

Json rounded(const NamedNumbers& numbers) {
  Json json = Json::object();
  for (const auto& [name, value] : numbers) json[name] = rounded(value);
  return json;
}

Json rounded(const std::vector<double>& matrix) {
  Json json = Json::array();
  for (const double value : matrix) json.push_back(rounded(value));
  return json;
}

Json to_json(const ReportedObject& found, ModelList& models) {
  return {{"model", models.number_of(found.obj_id, found.model)},
          {"confidence", rounded(found.confidence)},
          {"pose_confidence", rounded(found.pose_confidence)},
          {"score", rounded(found.score)},
          {"density", rounded(found.density)},
          {"runner_up_density", rounded(found.runner_up_density)},
          {"inlier_fraction", rounded(found.inlier_fraction)},
          {"rmse_m", rounded(found.rmse)},
          {"T", rounded(found.T_scene_model)},
          {"clues", rounded(found.clues)},
          {"against", rounded(found.against)},
          {"says", sentences(found)}};
}

/// The best of each object, the most confident first.
std::vector<ReportedObject> best_rejected(std::vector<ReportedObject> all) {
  std::stable_sort(all.begin(), all.end(), [](const ReportedObject& a, const ReportedObject& b) {
    return std::isfinite(a.confidence) && !(a.confidence <= b.confidence);
  });
  std::vector<ReportedObject> best;
  std::set<std::string> seen;
  for (ReportedObject& one : all)
    if (best.size() < kMostRejected && seen.insert(one.model).second)
      best.push_back(std::move(one));
  return best;
}

Json to_json(const AnsweredFrame& frame, ModelList& models) {
  Json json{{"number", rounded(frame.number)},
            {"name", frame.name},
            {"file", frame.file},
            {"seconds", rounded(frame.seconds)},
            {"latency", rounded(frame.latency)},
            {"warnings", frame.warnings},
            {"stages", rounded(frame.stages)},
            {"found", Json::array()},
            {"rejected", Json::array()}};
  for (const ReportedObject& found : frame.found) json["found"].push_back(to_json(found, models));
  for (const ReportedObject& best : best_rejected(frame.rejected))
    json["rejected"].push_back(to_json(best, models));
  return json;
}

Json to_json(const FailedFrame& failure) {
  return {{"number", rounded(failure.number)},
          {"name", name_of(failure)},
          {"file", failure.file},
          {"failure", {{"node", failure.node}, {"what", failure.what}}},
          {"found", Json::array()},
          {"rejected", Json::array()}};
}

Json to_json(const std::vector<layouts::TrueInstance>& truths, const ShownRun& inputs,
             ModelList& models) {
  Json list = Json::array();
  for (const layouts::TrueInstance& truth : truths) {
    std::vector<double> matrix;
    for (int i = 0; i < 16; ++i) matrix.push_back(truth.T_scene_model.matrix()(i / 4, i % 4));
    const int model = models.number_of(truth.obj_id, inputs.true_name(truth.obj_id));
    list.push_back({{"model", model}, {"T", rounded(matrix)}});
    if (truth.visible) list.back()["visible"] = rounded(*truth.visible);
  }
  return list;
}

/// A frame to be shown, and which scan it was.
struct Shown {
  Json json;
  ScanName scan;
};

/// Results may say anything; 0 where it is no number.
template <class Frame>
std::size_t frame_number(const Frame& frame) {
  return frame.number >= 0 && frame.number < 1e15 ? static_cast<std::size_t>(frame.number) : 0;
}

std::vector<Shown> list_frames(const RunResults& run, const ShownRun& inputs, const RunView& view,
                               ModelList& models) {
  std::vector<Shown> frames;
  for (const AnsweredFrame& frame : run.frames)
    if (is_wanted(frame.name, view))
      frames.push_back(
          {to_json(frame, models), {frame_number(frame), frame.file, frame.scene_id, frame.im_id}});
  for (const FailedFrame& failure : run.failures)
    if (is_wanted(name_of(failure), view))
      frames.push_back(
          {to_json(failure),
           {frame_number(failure), failure.file, 0, static_cast<int>(failure.number)}});
  for (auto& [json, scan] : frames) json["truth"] = to_json(inputs.truths(scan), inputs, models);
  return frames;
}

std::map<int, std::vector<Eigen::Isometry3d>> true_poses(const ShownRun& inputs,
                                                         const ScanName& scan) {
  std::map<int, std::vector<Eigen::Isometry3d>> poses;
  for (const layouts::TrueInstance& truth : inputs.truths(scan))
    poses[truth.obj_id].push_back(truth.T_scene_model);
  return poses;
}

/// Why each object was found or not, by object and instance.
void explain_scans(const std::filesystem::path& folder, const ShownRun& inputs, ModelList& models,
                   std::vector<Shown>& frames) {
  const explain::Run run = explain::open_run(folder);
  for (auto& [json, scan] : frames) {
    const explain::Explanation all = explain::explain(run, json["name"].get<std::string>(),
                                                      {"", true_poses(inputs, scan), false});
    Json list = Json::array();
    for (const explain::Explained& object : all.objects)
      list.push_back({{"model", models.number_of(object.obj_id, object.model)},
                      {"cause", explain::name_of(object.verdict.cause)},
                      {"says", object.sentences}});
    json["explained"] = {{"scan", all.sentences}, {"objects", list}};
  }
}

/// The packed bytes of each frame, beside its JSON.
std::string show_scans(std::vector<Shown>& frames, const ShownRun& inputs, const RunView& view,
                       const VotesWanted* votes, const std::string& id) {
  std::vector<std::string> blobs(frames.size());
  graph::parallel_for(frames.size(), 1, [&](std::size_t i) {
    blobs[i] = show_scan(frames[i].scan, inputs, votes, view.points,
                         fmt::format("{}-scan{}", id, i), frames[i].json);
  });
  std::string all;
  for (const std::string& blob : blobs) all += blob;
  return all;
}

std::string look_alike_sentence(const ReportedObject& object) {
  constexpr std::size_t kMostNamed = 3;
  std::string text =
      "What tells this pose from others is hidden, or lost in noise. As well may be: ";
  for (std::size_t i = 0; i < std::min(kMostNamed, object.look_alikes.size()); ++i) {
    const auto& [motion, probability] = object.look_alikes[i];
    text += fmt::format("{}{} ({:.0f} %)", i > 0 ? "; " : "",
                        turn_text(motion.topLeftCorner<3, 3>()), 100 * probability);
  }
  if (object.look_alikes.size() > kMostNamed)
    text += fmt::format("; and {} more", object.look_alikes.size() - kMostNamed);
  return text + ".";
}

}  // namespace

std::size_t count_scans(const RunResults& run, const RunView& view) {
  std::size_t count = 0;
  for (const AnsweredFrame& frame : run.frames) count += is_wanted(frame.name, view);
  for (const FailedFrame& failure : run.failures) count += is_wanted(name_of(failure), view);
  return count;
}

std::string run_markup(const std::filesystem::path& folder, const RunResults& run, ShownRun& inputs,
                       const RunView& view, const std::string& id) {
  ModelList models(inputs.models(), run.left_out);
  std::vector<Shown> frames = list_frames(run, inputs, view, models);
  if (view.explain) explain_scans(folder, inputs, models, frames);
  VotesWanted votes;
  if (!view.votes.empty()) {
    votes.obj_id = models.obj_id_of(view.votes);
    votes.constants = constants_of(inputs.configuration(), inputs.library());
  }
  const std::string scans =
      show_scans(frames, inputs, view, view.votes.empty() ? nullptr : &votes, id);
  const std::string surfaces = models.show(inputs.load_surfaces(), view.faces, id);
  Json json{{"models", models.to_json()}, {"scans", Json::array()}, {"truth", inputs.has_truth()}};
  for (Shown& frame : frames) json["scans"].push_back(std::move(frame.json));
  return fmt::format(
      "<div class=\"run\" data-run=\"{0}\"></div>\n"
      "<script type=\"application/json\" id=\"{0}\">{1}</script>\n{2}{3}",
      id, script_json(json), surfaces, scans);
}

std::string script_json(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&')
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      text += c;
  }
  return text;
}

std::vector<std::string> sentences(const ReportedObject& object) {
  std::vector<std::string> list;
  if (!object.why.empty()) list.push_back("Not taken: " + object.why + ".");
  const auto worst =
      std::max_element(object.against.begin(), object.against.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (worst != object.against.end() && worst->second > 0)
    list.push_back(fmt::format("Most against it: {}, which takes {:.1f} from its log odds.",
                               worst->first, worst->second));
  if (!object.look_alikes.empty()) list.push_back(look_alike_sentence(object));
  return list;
}

}  // namespace posevote::page
