// SPDX-License-Identifier: BSD-3-Clause
// What a run finds as tables, one row a detection, from the frame's object in results.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace posevote::formats {

/// A plain value in a table: text is quoted where it holds what a table lives by (RFC 4180); numbers
/// come out as they go in.
std::string csv_field(const nlohmann::ordered_json& value);

/// results.csv, in BOP's format; R row by row, t in mm, time in s.
inline constexpr const char* kBopHeader = "scene_id,im_id,obj_id,score,R,t,time\n";
std::string bop_rows(const nlohmann::ordered_json& frame);

/// detections.csv, for spreadsheets and robots: names beside numbers, t in m, the pose as a unit
/// quaternion. Quoted as in RFC 4180; lines end in a line feed.
inline constexpr const char* kTableHeader =
    "frame,scan,scene_id,im_id,obj_id,model,confidence,x_m,y_m,z_m,qw,qx,qy,qz,rms_m,pose_"
    "confidence\n";
std::string table_rows(const nlohmann::ordered_json& frame);

/// The tables that a format of write_results asks for.
struct TableFormat {
  const char* format;
  const char* file;
  const char* header;
  std::string (*rows)(const nlohmann::ordered_json& frame);
};
inline constexpr TableFormat kTables[] = {{"bop", "results.csv", kBopHeader, bop_rows},
                                          {"csv", "detections.csv", kTableHeader, table_rows}};

/// Whether `format` is one of those.
bool has(const std::vector<std::string>& formats, const std::string& format);

}  // namespace posevote::formats
