// SPDX-License-Identifier: BSD-3-Clause
// `posevote init`: looks at somebody's data, says what it sees, and writes a config that works.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/init/camera_beside.hpp"
#include "tools/init/look.hpp"
#include "tools/init/settings.hpp"
#include "tools/init/trials.hpp"

namespace posevote::init {

/// Options of `init`, named as on the command line.
struct Command {
  std::string out;
  std::vector<std::string> models, scenes;
  std::vector<double> camera;  ///< fx fy cx cy, or empty
  std::optional<double> depth_scale;
  std::string cache;
  std::size_t look = 3;  ///< scans to look at
  bool overwrite = false, json = false;
};

/// Something that is not as one would expect it.
struct Finding {
  std::string what;      ///< in a word: "unit", "depth scale", "sensor" ...
  std::string evidence;  ///< in figures
  std::string remedy;    ///< what the config does about it, or what the user can do
};

/// All that was seen and decided.
struct Report {
  std::vector<ModelLook> models;
  std::vector<ScanLook> scans;  ///< those that were looked at
  std::size_t all_scans = 0;
  Settings settings;
  std::string camera_from;  ///< words for where the camera of depth images comes from
  bool scale_said = false;  ///< their depth_scale comes with them, and goes before any config
  std::vector<Finding> wrong;
  std::string config;  ///< its file
  std::string run;     ///< the line to run it
  Trial first;         ///< of the config on the first readable scan
  std::string first_scan, picture;
};

/// Tries settings on the first readable scan and fills `settings` and what was wrong with the
/// defaults. `given`: what the user said.
void find_settings(const SceneFile& scan, const ScanLook& look, const Settings& given,
                   Trials& trials, Report& report);

/// Adds what is wrong with single files: unreadable ones, faces and normals, sizes that differ.
void find_oddities(const std::vector<SceneFile>& scans, Report& report);

/// The text of the config.
std::string config_text(const Report& report);

/// Tables and sentences for people; Markdown reads as well.
std::string to_text(const Report& report);
nlohmann::ordered_json to_json(const Report& report);  ///< the same for programs

int run(const Command& command);

}  // namespace posevote::init
