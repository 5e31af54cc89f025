// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/command.hpp"

#include <cstdio>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/sensor_pose.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/layouts/ground_truth.hpp"
#include "pipelines/inputs.hpp"
#include "tools/explain/misses.hpp"
#include "tools/explain/picture.hpp"
#include "tools/explain/sentences.hpp"
#include "tools/explain/to_json.hpp"
#include "tools/json_answer.hpp"

namespace posevote {
namespace {

using explain::Explanation;

/// A pose, in metres, from a file in another unit.
Eigen::Isometry3d read_pose(const std::string& file, const std::string& unit) {
  try {
    const std::vector<double> numbers = formats::read_pose_numbers(formats::read_file(file).view());
    if (numbers.size() != 16) throw std::runtime_error("expected 16 numbers, a matrix row by row");
    Eigen::Isometry3d pose = formats::sensor_pose(numbers);
    pose.translation() *= formats::metres_per(unit);
    return pose;
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    throw std::invalid_argument(what.starts_with(file) ? what : file + ": " + what);
  }
}

/// `targets`: as read_ground_truth takes it.
layouts::GroundTruth ground_truth(const ExplainCommand& command, const explain::Run& run,
                                  const std::string& targets) {
  const std::string split = run.inputs.manifest().split;
  return as_arguments([&] {
    return layouts::read_ground_truth(command.dataset, split.empty() ? "test" : split, targets);
  });
}

void read_truth(const ExplainCommand& command, const explain::Run& run,
                const explain::FrameOfRun& frame, explain::Request& request) {
  if (!command.truth.empty()) {
    if (command.object.empty())
      throw std::invalid_argument("--truth " + command.truth + ": say of which --object");
    for (const auto& model : run.library->models)
      if (model->name == command.object || std::to_string(model->obj_id) == command.object)
        request.truth[model->obj_id].push_back(read_pose(command.truth, command.truth_unit));
  }
  if (command.dataset.empty()) return;
  const SceneFile file = explain::scene_file(run, frame);
  request.truth =
      explain::poses_of(ground_truth(command, run, "none"), {file.scene_id, file.im_id});
}

/// Of every scan, what was missed.
void explain_misses(const ExplainCommand& command, const explain::Run& run,
                    const JsonAnswer& answer) {
  explain::Request request;
  request.object = command.object;
  const std::vector<explain::Miss> misses =
      explain::misses_of(run, ground_truth(command, run, ""), request, command.most);
  if (answer.wanted())
    answer.give(explain::to_json(misses));
  else
    std::printf("%s", explain::to_text(misses).c_str());
}

std::string only_scene(const ExplainCommand& command, const explain::Run& run) {
  if (!command.scene.empty()) return command.scene;
  if (run.frames.size() == 1) return run.frames.front().name;
  throw std::invalid_argument(command.out + ": the run has " + std::to_string(run.frames.size()) +
                              " scans; say --scene NAME, as " + run.frames.front().name +
                              ", or --dataset DIR for all that was missed");
}

}  // namespace

int explain_command(const ExplainCommand& command) {
  const JsonAnswer answer(command.json);
  const explain::Run run = explain::open_run(command.out, command.models);
  const bool is_of_all = command.scene.empty() && !command.dataset.empty() && run.frames.size() > 1;
  if (is_of_all) return explain_misses(command, run, answer), 0;
  const std::string scene = only_scene(command, run);
  explain::Request request;
  request.object = command.object;
  request.attempt = command.attempt;
  read_truth(command, run, explain::find_frame(run.frames, scene, run.out), request);
  const Explanation explanation = explain::explain(run, scene, request);
  if (!command.picture.empty()) {
    if (!explanation.taps)
      throw std::invalid_argument("--picture " + command.picture + ": the scan has failed");
    explain::draw(explanation, command.show, command.picture);
  }
  if (answer.wanted())
    answer.give(explain::to_json(explanation));
  else
    std::printf("%s", explain::to_text(explanation).c_str());
  return 0;
}

}  // namespace posevote
