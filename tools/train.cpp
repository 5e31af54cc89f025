// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "nodes/library/library_file.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "pipelines/overrides.hpp"
#include "tools/commands.hpp"
#include "tools/progress/progress.hpp"
#include "tools/symmetry_report.hpp"

namespace posevote {

int train_command(const TrainCommand& command) {
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
    std::cout << model->name << ": obj_id " << model->obj_id << ", " << model->cloud.points.rows()
              << " points, " << model->features.points.rows() << " features, "
              << model->symmetries.turns.size() << " turns, " << model->symmetries.axes.size()
              << " axes of symmetry, " << model->near_symmetries.items.size()
              << " near symmetries, diagonal " << model->diagonal << " m\n";
    if (command.report) std::cout << symmetry_report(*model);
  }
  for (const LibraryOctave& octave : library->octaves)
    std::cout << "octave of " << octave.resolution << " m: " << octave.rows.size() << " models\n";
  std::cout << "wrote " << command.out << "\n";
  tell_left_out(*library);
  return library->left_out.empty() ? 0 : 1;
}

}  // namespace posevote
