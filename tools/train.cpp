// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <sstream>

#include "nodes/library/library_file.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "pipelines/overrides.hpp"
#include "tools/commands.hpp"
#include "tools/json_answer.hpp"
#include "tools/progress/progress.hpp"
#include "tools/symmetry_report.hpp"

namespace posevote {

namespace {

std::string line_of(const Model& model) {
  std::ostringstream text;
  text << model.name << ": obj_id " << model.obj_id << ", " << model.cloud.points.rows()
       << " points, " << model.features.points.rows() << " features, "
       << model.symmetries.turns.size() << " turns, " << model.symmetries.axes.size()
       << " axes of symmetry, " << model.near_symmetries.items.size()
       << " near symmetries, diagonal " << model.diagonal << " m\n";
  return text.str();
}

nlohmann::ordered_json to_json(const Model& model) {
  return {{"model", model.name},
          {"obj_id", model.obj_id},
          {"points", model.cloud.points.rows()},
          {"features", model.features.points.rows()},
          {"turns", model.symmetries.turns.size()},
          {"axes", model.symmetries.axes.size()},
          {"near_symmetries", model.near_symmetries.items.size()},
          {"diagonal_m", model.diagonal},
          {"symmetries", symmetry_json(model)}};
}

nlohmann::ordered_json to_json(const ModelLibrary& library) {
  using nlohmann::ordered_json;
  ordered_json models = ordered_json::array(), octaves = models, left_out = models;
  for (const auto& model : library.models) models.push_back(to_json(*model));
  for (const LibraryOctave& octave : library.octaves)
    octaves.push_back({{"resolution_m", octave.resolution}, {"models", octave.rows.size()}});
  for (const LeftOutModel& model : library.left_out)
    left_out.push_back({{"model", model.name}, {"obj_id", model.obj_id}, {"why", model.why}});
  return {{"models", models}, {"octaves", octaves}, {"left_out", left_out}};
}

}  // namespace

int train_command(const TrainCommand& command) {
  const JsonAnswer answer(command.json);
  const Configuration configuration =
      load_configuration(command.config, command.set, {}, "", model_overrides(command.model_unit));
  const ModelFiles models = list_models(command.models);
  const auto library = [&] {
    graph::Activity activity;
    const Progress progress(
        {"training " + std::to_string(models.size()) + " models", 0, &activity, !command.quiet});
    return train(configuration, models, bad_models(command.on_error), &activity);
  }();
  library::save_library(*library, command.out, library_key(configuration));
  for (const auto& model : library->models) {
    std::cout << line_of(*model);
    if (command.report) std::cout << symmetry_report(*model);
  }
  for (const LibraryOctave& octave : library->octaves)
    std::cout << "octave of " << octave.resolution << " m: " << octave.rows.size() << " models\n";
  std::cout << "wrote " << command.out << "\n";
  tell_left_out(*library);
  answer.give(to_json(*library));
  return library->left_out.empty() ? 0 : 1;
}

}  // namespace posevote
