// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/results_csv.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "graph/schema.hpp"
#include "nodes/geometry/rotation.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

const std::string kHeader = "scene_id,im_id,obj_id,score,R,t,time";
const std::string kBelieved = kHeader + ",confidence";

template <class T>
T parse(const std::string& text, const std::string& name) {
  const std::optional<T> value = graph::Scalar<T>::parse(text);
  if (!value || !std::isfinite(static_cast<double>(*value)))
    throw std::invalid_argument(name + " is '" + text + "', expected a finite " +
                                graph::Scalar<T>::name());
  return *value;
}

template <std::size_t N>
std::array<double, N> parse_list(const std::string& text, const std::string& name) {
  std::vector<std::string> parts = split(text, ' ');
  std::erase(parts, "");
  if (parts.size() != N)
    throw std::invalid_argument(name + " has " + std::to_string(parts.size()) +
                                " numbers, expected " + std::to_string(N));
  std::array<double, N> values;
  for (std::size_t i = 0; i < N; ++i) values[i] = parse<double>(parts[i], name);
  return values;
}

FoundInstance parse_row(const std::string& text, const std::string& header) {
  const std::vector<std::string> fields = split(text, ',');
  const std::size_t expected = header == kBelieved ? 8 : 7;
  if (fields.size() != expected)
    throw std::invalid_argument("has " + std::to_string(fields.size()) + " fields, expected " +
                                std::to_string(expected) + ": " + header);
  FoundInstance found;
  found.scene_id = parse<int>(fields[0], "scene_id");
  found.im_id = parse<int>(fields[1], "im_id");
  found.obj_id = parse<int>(fields[2], "obj_id");
  found.score = parse<double>(fields[3], "score");
  if (header == kBelieved) found.score = parse<double>(fields[7], "confidence");
  const std::array<double, 3> t = parse_list<3>(fields[5], "t");
  found.T_scene_model =
      geometry::make_pose(parse_list<9>(fields[4], "R"), Eigen::Vector3d(t[0], t[1], t[2]) * 0.001);
  parse<double>(fields[6], "time");
  return found;
}

}  // namespace

std::vector<FoundInstance> read_results_csv(const std::string& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw std::runtime_error(file + ": cannot be read: no such file?");
  std::vector<FoundInstance> rows;
  int line = 0;
  std::string header = kHeader;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    if (text.ends_with('\r')) text.pop_back();
    if (line == 1 && text == kBelieved) header = kBelieved;
    if (text.empty() || (line == 1 && text == header)) continue;
    try {
      rows.push_back(parse_row(text, header));
      rows.back().line = line;
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(file + ":" + std::to_string(line) + ": " + error.what());
    }
  }
  if (line == 0)
    throw std::runtime_error(file + ": is empty, expected at least the line " + kHeader);
  return rows;
}

}  // namespace posevote
