// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/init.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "nodes/formats/depth_image.hpp"
#include "nodes/formats/format.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/json_answer.hpp"
#include "tools/text.hpp"
#include "tools/write_text.hpp"

namespace posevote::init {
namespace {

namespace fs = std::filesystem;

constexpr const char *kConfig = "config.yaml", *kReadme = "README.md", *kPicture = "first.png";

void refuse_to_overwrite(const Command& command) {
  const fs::path out = command.out;
  if (fs::exists(out) && !fs::is_directory(out))
    throw std::invalid_argument(command.out + ": is a file, expected a folder to write to");
  if (command.overwrite) return;
  for (const char* name : {kConfig, kReadme, kPicture})
    if (fs::exists(out / name))
      throw std::invalid_argument((out / name).string() +
                                  ": is there already; choose another folder or say --overwrite");
}

/// Quoted where a shell needs it.
std::string word(const std::string& text) {
  const bool plain = text.find_first_of(" \t\n'\"\\$`*?[](){}<>|&;#~!") == std::string::npos;
  if (plain && !text.empty()) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string words(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += " " + word(text);
  return all;
}

/// The camera that comes with a scan, which a run takes before the config's.
Camera scans_own(const Command& command, const SceneFile& scan, Report& report) {
  Camera camera = *scan.camera;
  report.scale_said = camera.depth_scale > 0;
  report.camera_from = "as the file beside the images says, which a run takes first";
  if (!report.scale_said) camera.depth_scale = command.depth_scale.value_or(1);
  if (!command.camera.empty() || (command.depth_scale && report.scale_said))
    report.wrong.push_back({"camera said twice",
                            "a file beside " + scan.path.filename().string() + " says it, too",
                            "a run takes the file's; mend or remove that file for another"});
  return camera;
}

/// What is known of a depth image's camera; where nobody says it, a usual one.
FoundCamera find_camera(const Command& command, const SceneFile& scan, Report& report) {
  constexpr double kUsualField = 60 * std::numbers::pi / 180;  // across
  const fs::path& image = scan.path;
  FoundCamera found;
  if (scan.camera) return {scans_own(command, scan, report), ""};
  if (!command.camera.empty()) {
    found.camera = {command.camera[0], command.camera[1], command.camera[2], command.camera[3], 1};
    report.camera_from = "as --camera says";
  } else if (const auto beside = camera_beside(image)) {
    found = *beside;
    report.camera_from = "as " + found.file.string() + " says";
  } else {
    const formats::DepthImage size = formats::read_depth_image(image);
    const auto width = static_cast<double>(size.width), height = static_cast<double>(size.height);
    const double focal = std::round(width / 2 / std::tan(kUsualField / 2));
    found.camera = {focal, focal, (width - 1) / 2, (height - 1) / 2, 1};
    report.camera_from = "A GUESS, of a camera that sees 60 deg across: write the true one";
    report.wrong.push_back(
        {"camera unknown",
         "nothing beside " + image.filename().string() +
             format(" says the camera of its %zu x %zu pixels", size.width, size.height),
         format("the config guesses fx = fy = %.0f, 60 deg across; say --camera FX FY CX CY, for "
                "shapes come out stretched by a wrong one",
                focal)});
  }
  if (command.depth_scale) found.camera.depth_scale = *command.depth_scale;
  return found;
}

void look_at_models(const ModelFiles& models, Report& report) {
  for (const ModelFile& model : models) {
    report.models.push_back(look_at_model(model));
    spdlog::info("looked at {}", model.path.string());
  }
}

/// Looks at the first few scans; depth images need a camera, which is sought for the first of them.
std::vector<SceneFile> look_at_scans(const Command& command, Settings& given, Report& report) {
  std::vector<SceneFile> files;
  for (const SceneEntry& entry : list_scenes(command.scenes)) {
    ++report.all_scans;
    if (files.size() == command.look) continue;
    if (!given.camera && formats::has_ending(entry.file.path, formats::Wanted::kDepthImages)) try {
        given.camera = find_camera(command, entry.file, report).camera;
      } catch (const std::exception&) {  // unreadable, which the look says
      }
    files.push_back(entry.file);
    report.scans.push_back(look_at_scan(entry.file, given.camera));
    spdlog::info("looked at {}", entry.file.path.string());
  }
  return files;
}

template <class Look>
std::size_t readable(const std::vector<Look>& looks) {
  return static_cast<std::size_t>(std::count_if(
      looks.begin(), looks.end(), [](const Look& look) { return look.unreadable.empty(); }));
}

void require_readable(const Report& report) {
  std::string text;
  if (readable(report.models) == 0)
    for (const ModelLook& look : report.models)
      text += "\n  " + look.file.string() + ": " + look.unreadable;
  if (readable(report.scans) == 0)
    for (const ScanLook& look : report.scans)
      text += "\n  " + look.file.string() + ": " + look.unreadable;
  if (!text.empty()) throw std::invalid_argument("nothing readable:" + text);
}

std::size_t first_readable(const Report& report) {
  const auto found = std::find_if(report.scans.begin(), report.scans.end(),
                                  [](const ScanLook& look) { return look.unreadable.empty(); });
  return static_cast<std::size_t>(found - report.scans.begin());
}

std::string run_line(const Command& command) {
  return "posevote run " + word((fs::path(command.out) / kConfig).string()) + " --models" +
         words(command.models) + " --scenes" + words(command.scenes) + " --out " +
         word((fs::path(command.out) / "out").string());
}

void write(const Command& command, const SceneFile& scan, Trials& trials, Report& report) {
  const fs::path out = command.out;
  fs::create_directories(out);
  if (command.overwrite)
    for (const char* name : {kConfig, kReadme, kPicture}) fs::remove(out / name);
  report.config = (out / kConfig).string();
  report.picture = (out / kPicture).string();
  write_text(report.config, config_text(report));
  report.first_scan = scan.path.string();
  report.first = trials.run(scan, report.config, report.picture);
  write_text(out / kReadme, "# What `posevote init` saw\n\n" + to_text(report) +
                                (fs::exists(report.picture)
                                     ? std::string("\n![The first scan](") + kPicture + ")\n"
                                     : ""));
}

}  // namespace

int run(const Command& command) {
  const JsonAnswer answer(command.json);
  refuse_to_overwrite(command);
  Report report;
  report.run = run_line(command);
  const ModelFiles models = list_models(command.models);
  look_at_models(models, report);
  Settings given;
  const std::vector<SceneFile> scans = look_at_scans(command, given, report);
  require_readable(report);

  Trials trials(models, command.cache.empty() ? default_cache() : fs::path(command.cache));
  const std::size_t first = first_readable(report);
  spdlog::info("trying units and scales on {}", scans[first].path.string());
  find_settings(scans[first], report.scans[first], given, trials, report);
  find_oddities(scans, report);
  write(command, scans[first], trials, report);
  if (answer.wanted())
    answer.give(to_json(report));
  else
    std::printf("%s\nWrote %s, %s and %s.\n", to_text(report).c_str(), report.config.c_str(),
                (fs::path(command.out) / kReadme).c_str(), report.picture.c_str());
  return 0;
}

}  // namespace posevote::init
