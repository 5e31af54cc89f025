// SPDX-License-Identifier: BSD-3-Clause
// The C++ side of python_cost.py: recognizer_cost POINTS UNIT MODEL..., where POINTS holds 32-bit
// floats x y z x y z ...; recognises once for every line that it reads, and prints the number of
// detections, the seconds that passed and those of all threads.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>

#include "pipelines/recognizer.hpp"

namespace {

std::vector<float> read_floats(const char* file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const float* begin = reinterpret_cast<const float*>(bytes.data());
  return {begin, begin + bytes.size() / sizeof(float)};
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu() { return double(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::vector<float> points = read_floats(argv[1]);
  posevote::RecognizerOptions options;
  options.model_unit = options.scene_unit = argv[2];
  std::vector<posevote::ObjectModel> models;
  for (int i = 3; i < argc; ++i) models.push_back(posevote::ObjectModel::from_file(argv[i]));
  const posevote::Recognizer recognizer(models, options);
  posevote::PointCloud cloud;
  cloud.points = points.data();
  cloud.count = points.size() / 3;
  for (std::string line; std::getline(std::cin, line);) {
    const double start = now(), busy = cpu();
    const posevote::Recognition answer = recognizer.recognize(cloud);
    std::printf("%zu %.9f %.9f\n", answer.found.size(), now() - start, cpu() - busy);
    std::fflush(stdout);
  }
}
