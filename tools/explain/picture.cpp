// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/picture.hpp"

#include <algorithm>

#include "nodes/density/find_modes.hpp"
#include "nodes/pictures/dense_votes.hpp"
#include "nodes/pictures/painter.hpp"
#include "tools/text.hpp"

namespace posevote::explain {
namespace {

using pictures::Colour;
using pictures::Painter;

constexpr int kWidth = 640;
constexpr std::size_t kMostVotes = 20000;

struct Posed {
  const Model* model;
  Eigen::Isometry3f T_scene_model;
  std::string words;
};

std::vector<Posed> posed_models(const Explanation& explanation, const ModelLibrary& library) {
  std::vector<Posed> all;
  for (const Explained& one : explanation.objects) {
    const Model* model = find_model(library, one.obj_id);
    if (!model) continue;
    if (one.best)
      all.push_back({model, one.best->T_scene_model.cast<float>(),
                     one.model + format(" %.2f", one.best->judged.confidence)});
    if (one.truth && !one.is_found && !one.best_is_true)
      all.push_back({model, one.truth->T_scene_model.cast<float>(), one.model + " true"});
  }
  return all;
}

void draw_candidates(const std::vector<Posed>& models, float resolution, Painter& painter) {
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Colour colour = pictures::distinct_colour(i);
    painter.draw(models[i].model->cloud, models[i].T_scene_model, colour, 2 * resolution);
    painter.label(models[i].T_scene_model * models[i].model->center, models[i].words, colour);
  }
}

/// Whether one of a correspondence's votes is near a best candidate of the object.
bool agrees(const VoteSet& votes, std::size_t correspondence, const std::vector<Alike>& best) {
  const auto each = static_cast<std::size_t>(votes.votes_per_correspondence);
  for (std::size_t v = correspondence * each; v < (correspondence + 1) * each; ++v) {
    const Hypothesis vote = density::vote_hypothesis(votes, static_cast<std::uint32_t>(v));
    for (const Alike& pose : best)
      if (pose.is_near(vote)) return true;
  }
  return false;
}

void draw_matches(const Explanation& explanation, Painter& painter) {
  const PointMatrix& features = explanation.taps->features->points;
  for (const auto& slot : explanation.taps->votes.slots) {
    const VoteSet& votes = *slot;
    std::vector<Alike> best;
    bool is_meant = false;
    for (const Explained& one : explanation.objects) {
      if (one.obj_id != votes.model->obj_id) continue;
      is_meant = true;
      if (one.best) best.emplace_back(*votes.model, one.best->T_scene_model);
    }
    if (!is_meant) continue;
    PointMatrix points(static_cast<Eigen::Index>(votes.scene_feature.size()), 3);
    std::vector<Colour> colours;
    for (std::size_t i = 0; i < votes.scene_feature.size(); ++i) {
      points.row(static_cast<Eigen::Index>(i)) = features.row(votes.scene_feature[i]);
      colours.push_back(agrees(votes, i, best) ? Colour(0.1F, 0.65F, 0.2F)
                                               : Colour(0.85F, 0.45F, 0.1F));
    }
    painter.dots(points, colours, 2);
  }
}

/// From blue over green and yellow to red.
Colour heat_colour(std::uint8_t heat) {
  const float at = static_cast<float>(heat) / 255 * 4;
  const auto ramp = [at](float middle) {
    return std::clamp(1.5F - std::abs(at - middle), 0.0F, 1.0F);
  };
  return {ramp(3), ramp(2), ramp(1)};
}

void draw_votes(const Explanation& explanation, Painter& painter) {
  const Taps& taps = *explanation.taps;
  for (std::size_t i = 0; i < taps.votes.size(); ++i) {
    const VoteSet& votes = taps.votes[i];
    const bool is_meant =
        std::any_of(explanation.objects.begin(), explanation.objects.end(),
                    [&](const Explained& one) { return one.obj_id == votes.model->obj_id; });
    if (!is_meant) continue;
    const pictures::DenseVotes dense =
        pictures::dense_votes(votes, taps.densities[i].density, kMostVotes);
    std::vector<Colour> colours;
    for (const std::uint8_t heat : dense.heat) colours.push_back(heat_colour(heat));
    painter.dots(dense.centers, colours, 1);
  }
}

}  // namespace

const std::vector<std::string>& drawn() {
  static const std::vector<std::string> kAll{"candidates", "matches", "votes"};
  return kAll;
}

void draw(const Explanation& explanation, const std::string& what,
          const std::filesystem::path& png) {
  const Taps& taps = *explanation.taps;
  const std::vector<Posed> models = posed_models(explanation, *taps.run.library);
  PointMatrix centers(static_cast<Eigen::Index>(models.size()), 3);
  for (std::size_t i = 0; i < models.size(); ++i)
    centers.row(static_cast<Eigen::Index>(i)) =
        (models[i].T_scene_model * models[i].model->center).transpose();
  const float resolution = taps.run.library->octaves.front().resolution;
  Painter painter(*taps.cloud, centers, kWidth, resolution);
  painter.draw(*taps.cloud, Eigen::Isometry3f::Identity(), {0.72F, 0.72F, 0.70F}, 0);
  if (what == "matches")
    draw_matches(explanation, painter);
  else if (what == "votes")
    draw_votes(explanation, painter);
  else
    draw_candidates(models, resolution, painter);
  painter.save(png);
}

}  // namespace posevote::explain
