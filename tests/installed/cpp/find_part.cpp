// SPDX-License-Identifier: BSD-3-Clause
// Finds a part in scans, from memory and from files: find_part MODEL SCAN...
#include <algorithm>
#include <cstdio>
#include <exception>
#include <posevote/recognizer.hpp>
#include <thread>
#include <vector>

namespace {

const double kSensor[] = {0.2, -0.3, 0.4};  // in the box's frame [m]
const double kHalf[] = {0.04, 0.025, 0.015};

/// What a driver of a sensor would hand over: a box of 80 x 50 x 30 mm and the table that it stands
/// on, where rays from the sensor meet them [m].
std::vector<float> box_on_table() {
  std::vector<float> points;
  for (int i = -150; i < 150; ++i)
    for (int k = -150; k < 150; ++k) {
      const double table[] = {0.001 * i, 0.001 * k, -kHalf[2]};
      double enter = 0, leave = 1;  // of the way from the sensor to the table
      for (int axis = 0; axis < 3; ++axis) {
        const double way = table[axis] - kSensor[axis];
        const double a = (-kHalf[axis] - kSensor[axis]) / way;
        const double b = (kHalf[axis] - kSensor[axis]) / way;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      const double at = enter < leave ? enter : 1;
      for (int axis = 0; axis < 3; ++axis)
        points.push_back(static_cast<float>(kSensor[axis] + at * (table[axis] - kSensor[axis])));
    }
  return points;
}

/// The same part as a mesh in memory.
posevote::ObjectModel box() {
  posevote::ObjectModel model;
  model.name = "box";
  for (int corner = 0; corner < 8; ++corner)
    model.points.insert(model.points.end(),
                        {(corner & 1) ? 0.04F : -0.04F, (corner & 2) ? 0.025F : -0.025F,
                         (corner & 4) ? 0.015F : -0.015F});
  model.faces = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return model;
}

void print(const posevote::Recognition& answer) {
  for (const posevote::FoundObject& found : answer.found)
    std::printf("%s: confidence %.2f at %.1f %.1f %.1f mm\n", found.name.c_str(), found.confidence,
                1e3 * found.T_scene_model[3], 1e3 * found.T_scene_model[7],
                1e3 * found.T_scene_model[11]);
  for (const std::string& warning : answer.warnings) std::printf("warning: %s\n", warning.c_str());
}

}  // namespace

int main(int argc, char** argv) try {
  std::printf("posevote %s\n", posevote::version().c_str());
  posevote::RecognizerOptions metres;
  metres.model_unit = metres.scene_unit = "m";
  const posevote::Recognizer boxes({box()}, metres);
  const std::vector<float> points = box_on_table();
  posevote::PointCloud cloud;
  cloud.points = points.data();
  cloud.count = points.size() / 3;
  cloud.sensor = kSensor;
  print(boxes.recognize(cloud));

  if (argc < 3) return 0;
  const posevote::Recognizer parts({posevote::ObjectModel::from_file(argv[1])});
  std::vector<posevote::Recognition> answers(static_cast<std::size_t>(argc - 2));
  std::vector<std::thread> threads;  // one recognizer serves them all
  for (std::size_t i = 0; i < answers.size(); ++i)
    threads.emplace_back([&, i] { answers[i] = parts.recognize_file(argv[2 + i]); });
  for (std::thread& thread : threads) thread.join();
  for (const posevote::Recognition& answer : answers) print(answer);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
