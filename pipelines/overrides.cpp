// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/overrides.hpp"

#include <filesystem>
#include <stdexcept>

#include "graph/schema.hpp"
#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/sensor_pose.hpp"

namespace posevote {
namespace {

graph::Override override_of(const std::string& option, const std::string& node,
                            const std::string& key, const std::string& value) {
  graph::Override change{node, key, {}};
  change.setting.text = value;
  change.setting.where.file = option;
  return change;
}

std::vector<double> read_sensor_pose(const std::string& text) {
  const bool is_file = std::filesystem::exists(text);
  try {
    const std::vector<double> numbers =
        is_file ? formats::read_pose_numbers(formats::read_file(text).view())
                : formats::read_pose_numbers(text);
    formats::sensor_pose(numbers);  // so that what is wrong is said with the option and the file
    return numbers;
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument("--sensor-pose " + text + ": " + error.what() +
                                (is_file ? "" : "; there is no such file either"));
  }
}

}  // namespace

std::vector<graph::Override> model_overrides(const std::string& model_unit) {
  if (model_unit.empty()) return {};
  return {override_of("--model-unit", "load_models", "unit", model_unit)};
}

std::vector<graph::Override> scene_overrides(const std::string& scene_unit,
                                             const std::string& sensor_pose) {
  std::vector<graph::Override> changes;
  if (!scene_unit.empty())
    changes.push_back(override_of("--scene-unit", "load_scene", "unit", scene_unit));
  if (!sensor_pose.empty())
    changes.push_back(
        override_of("--sensor-pose", "load_scene", "sensor_pose",
                    graph::Scalar<std::vector<double>>::print(read_sensor_pose(sensor_pose))));
  return changes;
}

}  // namespace posevote
