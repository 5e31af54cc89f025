// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/results_tables.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace posevote::formats {

using nlohmann::ordered_json;

std::string csv_field(const ordered_json& value) {
  if (!value.is_string()) return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  const auto text = value.get<std::string>();
  if (text.find_first_of("\",\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string bop_rows(const ordered_json& frame) {
  std::string rows;
  char text[512];
  for (const ordered_json& found : frame.at("detections")) {
    std::array<double, 12> T{};  // upper three rows
    for (std::size_t i = 0; i < T.size(); ++i) T[i] = found.at("T_scene_model").at(i).get<double>();
    std::snprintf(
        text, sizeof text,
        "%d,%d,%d,%.6f,%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g,%.6f %.6f %.6f,%.3f\n",
        frame.at("scene_id").get<int>(), frame.at("im_id").get<int>(),
        found.at("obj_id").get<int>(), found.at("confidence").get<double>(), T[0], T[1], T[2], T[4],
        T[5], T[6], T[8], T[9], T[10], 1e3 * T[3], 1e3 * T[7], 1e3 * T[11],
        frame.at("seconds").get<double>());
    rows += text;
  }
  return rows;
}

std::string table_rows(const ordered_json& frame) {
  std::string rows;
  for (const ordered_json& found : frame.at("detections")) {
    for (const char* key : {"frame", "file", "scene_id", "im_id"})
      rows += csv_field(frame.at(key)) + ",";
    for (const char* key : {"obj_id", "model", "confidence"})
      rows += csv_field(found.at(key)) + ",";
    for (const char* key : {"t_m", "q_wxyz"})
      for (const ordered_json& number : found.at(key)) rows += csv_field(number) + ",";
    const auto very_pose = found.find("pose_confidence");  // not of a run by an earlier version
    rows += csv_field(found.at("rmse_m")) + "," +
            (very_pose != found.end() ? csv_field(*very_pose) : "") + "\n";
  }
  return rows;
}

bool has(const std::vector<std::string>& formats, const std::string& format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

}  // namespace posevote::formats
