// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <nlohmann/json.hpp>

#include "nodes/formats/units.hpp"
#include "tools/init/init.hpp"
#include "tools/text.hpp"

namespace posevote::init {
namespace {

using Row = std::vector<std::string>;

/// Columns as wide as their widest cell, in Markdown.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows[0].size(), 3);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += (i == 0 ? "| " : " | ") + row[i] + std::string(widths[i] - row[i].size(), ' ');
    text += " |\n";
    if (&row != &rows[0]) continue;
    for (const std::size_t width : widths) text += "|" + std::string(width + 2, '-');
    text += "|\n";
  }
  return text;
}

std::string sides(const Eigen::Vector3d& sides, double scale) {
  const Eigen::Vector3d s = sides * scale;
  return format("%.4g x %.4g x %.4g", s.x(), s.y(), s.z());
}

std::string surface(const ModelLook& model) {
  if (model.faces == 0) return "points alone";
  std::string text = model.open_edges == 0 ? "closed" : format("%zu open edges", model.open_edges);
  if (model.parts > 1) text += format(", %zu parts", model.parts);
  return text;
}

std::string normals(const ModelLook& model) {
  if (model.turned > 0.5) return "faces inside out";
  if (!model.outward) return model.faces > 0 ? "of the faces" : "none";
  return format("%.0f %% outward", 100 * *model.outward);
}

std::string models_table(const Report& report) {
  const std::string& unit = report.settings.model_unit;
  std::vector<Row> rows{
      {"model", "points", "faces", "size [" + unit + "]", "diagonal [m]", "surface", "normals"}};
  for (const ModelLook& model : report.models)
    if (!model.unreadable.empty())
      rows.push_back({model.name, "unreadable", "", "", "", "", ""});
    else
      rows.push_back({model.name, std::to_string(model.points), std::to_string(model.faces),
                      sides(model.sides, 1),
                      format("%.4g", model.diagonal * formats::metres_per(unit)), surface(model),
                      normals(model)});
  return table(rows);
}

/// Metres in a unit of the look.
double metres(const Report& report, const ScanLook& scan) {
  return scan.is_depth ? report.settings.camera->depth_scale
                       : formats::metres_per(report.settings.scene_unit);
}

std::string kind(const ScanLook& scan) {
  if (scan.is_depth) return format("depth image %zu x %zu", scan.width, scan.height);
  if (scan.width > 0) return format("organised %zu x %zu", scan.width, scan.height);
  return "points";
}

std::string sensor(const Report& report, const ScanLook& scan) {
  if (scan.is_depth) return "its camera";
  if (report.settings.sensor) return "in the config";
  if (scan.says_sensor) return "said by a file";
  if (scan.facing && *scan.facing < 0.7) return "not at the origin";
  return scan.lies_before ? "origin" : "unknown";
}

std::string scans_table(const Report& report) {
  std::vector<Row> rows{{"scan", "kind", "points", "size [m]", "range [m]", "spacing [mm]",
                         "noise [mm]", "normals to sensor", "sensor"}};
  for (const ScanLook& scan : report.scans) {
    const std::string name = scan.file.filename().string();
    if (!scan.unreadable.empty()) {
      rows.push_back({name, "unreadable", "", "", "", "", "", "", ""});
      continue;
    }
    const double m = metres(report, scan);
    rows.push_back({name, kind(scan), std::to_string(scan.points), sides(scan.sides, m),
                    format("%.3g", scan.range * m), format("%.2g", 1000 * scan.spacing * m),
                    format("%.2g", 1000 * scan.noise * m),
                    scan.facing ? format("%.0f %%", 100 * *scan.facing) : "none",
                    sensor(report, scan)});
  }
  return table(rows);
}

std::string ratios(const Report& report) {
  double least = 1e300, most = 0;
  for (const ModelLook& model : report.models)
    if (model.unreadable.empty())
      least = std::min(least, model.diagonal), most = std::max(most, model.diagonal);
  for (const ScanLook& scan : report.scans) {
    if (!scan.unreadable.empty()) continue;
    const double size = scan.diagonal * metres(report, scan);
    const double m = formats::metres_per(report.settings.model_unit);
    return format(
        "The first scan is %.3g times as large as the largest model, %.3g times as large "
        "as the smallest; the\nsmallest is %.0f point spacings across.\n",
        size / (most * m), size / (least * m),
        least * m / std::max(1e-12, scan.spacing * metres(report, scan)));
  }
  return "";
}

std::string wrong(const Report& report) {
  if (report.wrong.empty()) return "Nothing looks wrong.\n";
  std::string text = "What looks wrong:\n";
  int number = 0;
  for (const Finding& finding : report.wrong)
    text += std::to_string(++number) + ". **" + finding.what + "**: " + finding.evidence +
            ".\n   -> " + finding.remedy + ".\n";
  return text;
}

std::string first(const Report& report) {
  if (report.first_scan.empty()) return "";
  std::string text = "This config on " + report.first_scan + ": ";
  if (!report.first.failed.empty()) return text + report.first.failed + "\n";
  text += std::to_string(report.first.found.size()) + " found";
  for (const Detection& found : report.first.found)
    text += "\n    " + found.model +
            format(", confidence %.2f, rms %.2g mm", found.confidence, 1000 * found.rmse);
  if (report.first.found.empty())
    text += format("; the best candidate has %.2f", report.first.best);
  return text + "\n";
}

nlohmann::ordered_json list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json to_json(const ModelLook& model) {
  nlohmann::ordered_json json{{"file", model.file.string()}};
  if (!model.unreadable.empty()) return json["unreadable"] = model.unreadable, json;
  json.update({{"points", model.points},
               {"faces", model.faces},
               {"size", list(model.sides)},
               {"diagonal", model.diagonal},
               {"parts", model.parts},
               {"open_edges", model.open_edges},
               {"wound_inward", model.turned}});
  if (model.outward) json["normals_outward"] = *model.outward;
  return json;
}

nlohmann::ordered_json to_json(const ScanLook& scan) {
  nlohmann::ordered_json json{{"file", scan.file.string()}};
  if (!scan.unreadable.empty()) return json["unreadable"] = scan.unreadable, json;
  json.update({{"kind", kind(scan)},
               {"points", scan.points},
               {"size", list(scan.sides)},
               {"diagonal", scan.diagonal},
               {"range", scan.range},
               {"spacing", scan.spacing},
               {"noise", scan.noise},
               {"sensor", list(scan.sensor)}});
  if (scan.facing) json["normals_to_sensor"] = *scan.facing;
  return json;
}

}  // namespace

std::string to_text(const Report& report) {
  return models_table(report) + "\n" + scans_table(report) +
         format("%zu of %zu scans looked at. ", report.scans.size(), report.all_scans) +
         ratios(report) + "\n" + wrong(report) + "\n" + first(report) + "\nRun it:\n\n    " +
         report.run + "\n";
}

nlohmann::ordered_json to_json(const Report& report) {
  nlohmann::ordered_json json{{"models", nlohmann::json::array()},
                              {"scans", nlohmann::json::array()},
                              {"wrong", nlohmann::json::array()},
                              {"found", nlohmann::json::array()}};
  for (const ModelLook& model : report.models) json["models"].push_back(to_json(model));
  for (const ScanLook& scan : report.scans) json["scans"].push_back(to_json(scan));
  for (const Finding& finding : report.wrong)
    json["wrong"].push_back(
        {{"what", finding.what}, {"evidence", finding.evidence}, {"config", finding.remedy}});
  for (const Detection& found : report.first.found)
    json["found"].push_back({{"model", found.model}, {"confidence", found.confidence}});
  json["set"] = report.settings.sets();
  json["config"] = report.config;
  json["run"] = report.run;
  return json;
}

}  // namespace posevote::init
