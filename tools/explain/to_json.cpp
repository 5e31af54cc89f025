// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/to_json.hpp"

namespace posevote::explain {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Isometry3d& pose) {
  Json rows = Json::array();
  for (int i = 0; i < 16; ++i) rows.push_back(pose.matrix()(i / 4, i % 4));
  return rows;
}

Json to_json(const Clues& values) {
  Json clues;
  for (std::size_t i = 0; i < kClueCount; ++i) clues[kClueNames[i]] = values[i];
  return clues;
}

Json to_json(const Judged& judged) {
  Json against = to_json(judged.against);
  against["colors"] = judged.colors_against;
  return {{"confidence", judged.confidence},
          {"forgiven", judged.forgiven()},
          {"score", judged.score},
          {"agreement", judged.agreement},
          {"relief", judged.relief},
          {"outline", judged.outline},
          {"votes_per_feature", judged.votes_per_feature},
          {"rmse_m", judged.rmse},
          {"clues", to_json(judged.clues)},
          {"against", against}};
}

Json to_json(const std::vector<Place>& way) {
  Json steps = Json::array();
  for (const Place& place : way)
    steps.push_back({{"step", place.step}, {"place", place.place}, {"of", place.of}});
  return steps;
}

Json to_json(const Standing& standing) {
  Json json{{"T_scene_model", to_json(standing.T_scene_model)},
            {"range_m", standing.range},
            {"seen",
             {{"supported", standing.seen.supported},
              {"contradicted", standing.seen.contradicted},
              {"mismatched", standing.seen.mismatched},
              {"unmeasured", standing.seen.unmeasured},
              {"hidden", standing.seen.hidden},
              {"outside", standing.seen.outside},
              {"scan_points", standing.seen.scan_points}}},
            {"features", standing.features},
            {"matched", standing.matched},
            {"other", standing.other},
            {"matched_other", standing.matched_other},
            {"agreeing", standing.agreeing},
            {"pairs", standing.pairs},
            {"density", standing.density},
            {"highest_density", standing.highest},
            {"rank", standing.rank},
            {"peaks", standing.peaks},
            {"search", to_json(standing.way)},
            {"judged", to_json(standing.judged)},
            {"judged_of_the_rest", to_json(standing.left)},
            {"moved_m", standing.moved},
            {"turned_rad", standing.turned},
            {"stayed", standing.stayed},
            {"taken", standing.taken},
            {"taker", standing.taker},
            {"inside", standing.inside}};
  if (standing.near_same) json["nearest_found_m"] = *standing.near_same;
  return json;
}

Json to_json(const Explained& one) {
  Json json{{"obj_id", one.obj_id},
            {"model", one.model},
            {"found", one.is_found},
            {"one_more", one.is_one_more},
            {"verdict", to_json(one.verdict)}};
  json["without_truth"] = to_json(one.guess);
  json["sentences"] = one.sentences;
  if (one.best) json["best"] = to_json(*one.best);
  if (one.truth) {
    json["truth"] = to_json(*one.truth);
    json["best_is_true"] = one.best_is_true;
  }
  Json attempts = Json::array();
  for (const Attempt& attempt : one.attempts)
    attempts.push_back({{"setting", attempt.setting},
                        {"found", attempt.is_found},
                        {"confidence", attempt.confidence},
                        {"detections", attempt.detections},
                        {"detections_before", attempt.before}});
  json["tried"] = attempts;
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Explanation& explanation) {
  Json figures = Json::object();
  for (const auto& [name, figure] : explanation.taps ? explanation.taps->figures : graph::Figures())
    figures[name] = figure.size() == 1 ? Json(figure[0]) : Json(figure);
  Json objects = Json::array();
  for (const Explained& one : explanation.objects) objects.push_back(to_json(one));
  return {{"frame", explanation.frame.number},       {"name", explanation.frame.name},
          {"file", explanation.frame.file.string()}, {"scan", figures},
          {"sentences", explanation.sentences},      {"objects", objects}};
}

nlohmann::ordered_json to_json(const Verdict& verdict) {
  return {{"cause", name_of(verdict.cause)}, {"stage", verdict.stage}, {"detail", verdict.detail}};
}

}  // namespace posevote::explain
