// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with single files, whatever the settings.
#include <algorithm>
#include <cmath>

#include "nodes/formats/units.hpp"
#include "tools/init/init.hpp"
#include "tools/text.hpp"

namespace posevote::init {
namespace {

double percent(double share) { return 100 * share; }

void find_in_model(const ModelLook& model, std::vector<Finding>& wrong) {
  constexpr double kMost = 0.02;
  const std::string name = model.file.filename().string() + ": ";
  const auto add = [&](const char* what, const std::string& evidence, const std::string& remedy) {
    wrong.push_back({what, name + evidence, remedy});
  };
  if (!model.unreadable.empty())
    return add("model unreadable", model.unreadable, "it is left out; mend or remove the file");
  if (model.turned > kMost)
    add("model inside out",
        format("the faces at %.0f %% of its points are wound inward", percent(model.turned)),
        "nothing to do: they are turned when the model is trained");
  if (model.outward && 1 - *model.outward > kMost)
    add("model normals", format("%.0f %% of its normals point inward", percent(1 - *model.outward)),
        "nothing to do: normals of models are made anew, from faces or points");
  if (model.faces == 0 && !model.outward)
    add("model without faces and normals", format("%zu bare points", model.points),
        "its normals are made from the points; a mesh would be safer");
  if (model.faces > 0 && model.open_edges > model.faces / 10)
    add("model open",
        format("%zu edges of its %zu faces end in nothing", model.open_edges, model.faces),
        "it works if what is missing is never seen; else use a closed mesh");
}

/// What load_scene says of the scan under the settings, and its normals.
void find_in_scan(const SceneFile& file, const ScanLook& scan, const Settings& settings,
                  std::vector<Finding>& wrong) {
  const std::string name = scan.file.filename().string() + ": ";
  if (!scan.unreadable.empty()) {
    wrong.push_back({"scan unreadable", name + scan.unreadable, "a run leaves it out, by name"});
    return;
  }
  if (scan.is_depth) return;
  std::vector<std::string> sets{"unit=" + settings.scene_unit};
  if (settings.sensor)
    sets.push_back("sensor_pose=[" + number(settings.sensor->x()) + "," +
                   number(settings.sensor->y()) + "," + number(settings.sensor->z()) + "]");
  const LoadedScan loaded = load_scan(file, sets);
  for (const std::string& warning : loaded.warnings) {
    const bool inverted = warning.find("taken as inverted") != std::string::npos;
    const bool elsewhere = warning.find("taken to have stood") != std::string::npos;
    if (warning.find("lies around") != std::string::npos) continue;  // told with the trials
    wrong.push_back({inverted    ? "normals inverted"
                     : elsewhere ? "sensor elsewhere"
                                 : "sensor or normals",
                     name + warning,
                     inverted    ? "nothing to do: they are turned to the sensor"
                     : elsewhere ? "nothing to do: each scan's normals tell it roughly; the config "
                                   "has a line for the exact place"
                                 : "say in the config where the sensor stood"});
  }
  if (!scan.facing)
    wrong.push_back({"no normals", name + format("none of its %zu points has one", scan.points),
                     "nothing to do: they are made from the points and turned to the sensor"});
}

/// Scans of one kind whose sizes only another unit explains.
void find_other_sizes(const std::vector<ScanLook>& scans, std::vector<Finding>& wrong) {
  constexpr double kTooMuch = 100;
  const ScanLook* first = nullptr;
  for (const ScanLook& scan : scans) {
    if (!scan.unreadable.empty()) continue;
    if (!first) first = &scan;
    if (scan.is_depth != first->is_depth) continue;
    const double ratio = scan.diagonal / first->diagonal;
    if (ratio < kTooMuch && ratio > 1 / kTooMuch) continue;
    wrong.push_back({"scans of different units",
                     scan.file.filename().string() + format(" is %.4g across, ", scan.diagonal) +
                         first->file.filename().string() + format(" %.4g", first->diagonal),
                     "the config is for the latter; run the others with --scene-unit"});
  }
}

/// What is the same with several files is said once, with the figures of the first.
std::vector<Finding> merged(const std::vector<Finding>& all) {
  std::vector<Finding> kept;
  std::vector<int> more;
  for (const Finding& finding : all) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Finding& other) {
      return other.what == finding.what && other.remedy == finding.remedy &&
             other.what.find("unreadable") == std::string::npos;  // each by name
    });
    if (same == kept.end())
      kept.push_back(finding), more.push_back(0);
    else
      ++more[static_cast<std::size_t>(same - kept.begin())];
  }
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (more[i] > 0) kept[i].evidence += format("; and likewise of %d more", more[i]);
  return kept;
}

}  // namespace

void find_oddities(const std::vector<SceneFile>& scans, Report& report) {
  for (const ModelLook& model : report.models) find_in_model(model, report.wrong);
  for (std::size_t i = 0; i < report.scans.size(); ++i)
    find_in_scan(scans[i], report.scans[i], report.settings, report.wrong);
  find_other_sizes(report.scans, report.wrong);
  report.wrong = merged(report.wrong);
}

}  // namespace posevote::init
