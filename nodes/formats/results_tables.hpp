// SPDX-License-Identifier: BSD-3-Clause
// What a run finds as tables, one row a detection, from the frame's object in results.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace posevote::formats {

/// results.csv, in BOP's format; R row by row, t in mm, time in s.
inline constexpr const char* kBopHeader = "scene_id,im_id,obj_id,score,R,t,time\n";
std::string bop_rows(const nlohmann::ordered_json& frame);

/// detections.csv, for spreadsheets and robots: names beside numbers, t in m, the pose as a unit
/// quaternion. Quoted as in RFC 4180; lines end in a line feed.
inline constexpr const char* kTableHeader =
    "frame,scan,scene_id,im_id,obj_id,model,confidence,x_m,y_m,z_m,qw,qx,qy,qz,rms_m\n";
std::string table_rows(const nlohmann::ordered_json& frame);

}  // namespace posevote::formats
