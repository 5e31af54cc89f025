// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/picture.hpp"

#include "nodes/pictures/painter.hpp"
#include "tools/text.hpp"

namespace posevote::explain {
namespace {

constexpr int kWidth = 1280;

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

}  // namespace

void draw(const Explanation& explanation, const Run& run, const std::filesystem::path& png) {
  const std::vector<Posed> models = posed_models(explanation, *run.library);
  PointMatrix centers(static_cast<Eigen::Index>(models.size()), 3);
  for (std::size_t i = 0; i < models.size(); ++i)
    centers.row(static_cast<Eigen::Index>(i)) =
        (models[i].T_scene_model * models[i].model->center).transpose();
  const float resolution = run.library->octaves.front().resolution;
  pictures::Painter painter(*explanation.cloud, centers, kWidth, resolution);
  painter.draw(*explanation.cloud, Eigen::Isometry3f::Identity(), {0.72F, 0.72F, 0.70F}, 0);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const pictures::Colour colour = pictures::distinct_colour(i);
    painter.draw(models[i].model->cloud, models[i].T_scene_model, colour, 2 * resolution);
    painter.label(models[i].T_scene_model * models[i].model->center, models[i].words, colour);
  }
  painter.save(png);
}

}  // namespace posevote::explain
