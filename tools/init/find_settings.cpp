// SPDX-License-Identifier: BSD-3-Clause
// Sizes say which units and scales may be meant; a run on one scan says which one is.
#include <algorithm>
#include <cmath>

#include "nodes/formats/units.hpp"
#include "tools/init/candidates.hpp"
#include "tools/init/init.hpp"
#include "tools/text.hpp"

namespace posevote::init {
namespace {

constexpr std::size_t kMostTrials = 12;

/// A candidate and what came of it.
struct Tried {
  Settings settings;
  Trial trial;
};

/// "0.98" or "nothing".
std::string confidence(const Trial& trial) {
  return trial.found.empty() ? "nothing" : format("%.2f", trial.best);
}

std::string name_of(const Settings& settings) {
  if (settings.camera)
    return format("depth_scale %.4g, models in %s", settings.camera->depth_scale,
                  settings.model_unit.c_str());
  return "scans in " + settings.scene_unit + ", models in " + settings.model_unit;
}

/// Goes through the candidates until one is sure; returns the best.
std::size_t try_all(const SceneFile& scan, const std::vector<Settings>& candidates, Trials& trials,
                    std::vector<Tried>& tried) {
  std::size_t best = 0;
  for (const Settings& settings : candidates) {
    if (tried.size() >= kMostTrials) break;
    tried.push_back({settings, trials.run(scan, settings)});
    if (tried.back().trial.best > tried[best].trial.best) best = tried.size() - 1;
    if (tried[best].trial.best >= kSure) break;
  }
  return best;
}

std::string list_trials(const std::vector<Tried>& tried, std::size_t best) {
  std::string text;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (i != best)
      text += (text.empty() ? "" : "; ") + name_of(tried[i].settings) + ": " +
              confidence(tried[i].trial);
  return text;
}

double largest(const std::vector<ModelLook>& models) {
  double size = 0;
  for (const ModelLook& model : models) size = std::max(size, model.diagonal);
  return size;
}

/// Sizes as they stand in the files and as they are read.
std::string sizes(const Report& report, const ScanLook& look) {
  const Settings& s = report.settings;
  const double model = largest(report.models);
  std::string text = format("the largest model is %.4g across: %.4g m, read as %s", model,
                            model * formats::metres_per(s.model_unit), s.model_unit.c_str());
  if (look.is_depth)
    return text + format("; the depth image %.4g m at depth_scale %.4g",
                         look.diagonal * s.camera->depth_scale, s.camera->depth_scale);
  return text + format("; the scan %.4g: %.4g m, read as %s", look.diagonal,
                       look.diagonal * formats::metres_per(s.scene_unit), s.scene_unit.c_str());
}

/// Of point files and their models.
void tell_units(const ScanLook& look, const std::string& trials, Report& report) {
  const Settings& s = report.settings;
  const bool differ = s.model_unit != s.scene_unit;
  if (!differ && s.model_unit == "m" && trials.empty()) return;
  Finding finding;
  finding.what = differ ? "units differ" : "unit";
  finding.evidence = differ ? "models are in " + s.model_unit + ", scans in " + s.scene_unit + ": "
                            : "models and scans are in " + s.model_unit + ", not metres: ";
  finding.evidence += sizes(report, look);
  if (!differ) finding.evidence += format("; as metres it would be %.4g m across", look.diagonal);
  if (!trials.empty()) finding.evidence += ". Tried and worse: " + trials;
  finding.remedy =
      "the config says load_models.unit: " + s.model_unit + ", load_scene.unit: " + s.scene_unit;
  report.wrong.push_back(finding);
}

/// Of depth images.
void tell_scale(const ScanLook& look, double given, const std::string& trials, Report& report) {
  const Settings& s = report.settings;
  const double scale = s.camera->depth_scale;
  if (scale == given) return;
  report.wrong.push_back(
      {"depth scale",
       format("at %.4g mm a unit the scan is %.4g m across, and what is found fits only at %.4g mm "
              "a unit (%.4g units to the metre), %.4g times %s: %.4g m",
              given, look.diagonal * given, scale, 1000 / scale,
              scale < given ? given / scale : scale / given, scale < given ? "nearer" : "farther",
              look.diagonal * scale) +
           ". Tried and worse: " + trials,
       report.scale_said ? "write depth_scale " + number(scale) +
                               " into the camera file beside the images: it goes before the config"
                         : "the config says load_scene.depth_scale: " + number(scale)});
}

void tell_nothing(const ScanLook& look, const std::vector<Tried>& tried, Report& report) {
  const std::string why =
      tried[0].trial.failed.empty()
          ? format("the best candidate has a confidence of %.2f", tried[0].trial.best)
          : tried[0].trial.failed;
  report.wrong.push_back(
      {"nothing found",
       sizes(report, look) + "; " + why + ". Tried: " + list_trials(tried, tried.size()),
       "the config takes the sizes that are likeliest; is any of the models in this scan?"});
}

/// Tries other places of the sensor, where nobody says where it stood and nothing else tells.
std::optional<Finding> find_sensor(const SceneFile& scan, const ScanLook& look, Trials& trials,
                                   Tried& best) {
  if (look.is_depth || look.says_sensor || look.facing || best.settings.sensor) return {};
  if (look.lies_before && best.trial.best >= kSure) return {};
  const double unit = formats::metres_per(best.settings.scene_unit);
  const std::vector<Eigen::Vector3d> places =
      likely_sensors(load_scan(scan, {"unit=m", "sensor_pose=[0,0,0]"}).scan);
  const double before = best.trial.best;
  for (const Eigen::Vector3d& place : places) {
    Settings settings = best.settings;
    settings.sensor = place;
    Trial trial = trials.run(scan, settings);
    if (trial.best > best.trial.best) best = {settings, std::move(trial)};
    if (best.trial.best >= kSure) break;
  }
  const std::string around =
      look.lies_before ? "the scan has no normals, and its origin may not be its sensor"
                       : "the scan lies around its origin, so its sensor hardly stood there, and "
                         "it has no normals that would tell where";
  if (best.settings.sensor) {
    const Eigen::Vector3d at = *best.settings.sensor * unit;
    return Finding{
        "sensor elsewhere",
        around + format(": of %zu places from where nearly all of it is seen, the sensor at (%.3g, "
                        "%.3g, %.3g) m finds with a confidence of %.2f, at the origin %.2f",
                        places.size(), at.x(), at.y(), at.z(), best.trial.best, before),
        "the config says load_scene.sensor_pose, roughly; write the exact place there"};
  }
  if (look.lies_before) return {};
  return Finding{"sensor unknown", around,
                 "say where it stood: load_scene.sensor_pose in the config, a file NAME.pose "
                 "beside each scan, or --sensor-pose"};
}

}  // namespace

void find_settings(const SceneFile& scan, const ScanLook& look, const Settings& given,
                   Trials& trials, Report& report) {
  std::vector<Tried> tried;
  std::vector<Settings> candidates = likely_settings(report.models, look, given);
  if (candidates.empty()) candidates.push_back(given);
  const std::size_t index = try_all(scan, candidates, trials, tried);
  Tried best = tried[index];
  const std::optional<Finding> sensor = find_sensor(scan, look, trials, best);
  report.settings = best.settings;
  const std::string worse = list_trials(tried, index);
  if (best.trial.found.empty()) tell_nothing(look, tried, report);
  if (look.is_depth)
    tell_scale(look, given.camera->depth_scale, worse, report);
  else
    tell_units(look, worse, report);
  if (sensor) report.wrong.push_back(*sensor);
}

}  // namespace posevote::init
