// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/json_text.hpp"
#include "tools/report/csv_table.hpp"
#include "tools/report/folder.hpp"
#include "tools/report/sections.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// "" where there is none.
std::string plot(const fs::path& svg) {
  try {
    const formats::FileBytes bytes = formats::read_file(svg);
    return "<div class=\"wide\">" +
           html::image("svg+xml", bytes.view(), svg.stem().string(), "class=\"plot\"") + "</div>\n";
  } catch (const std::runtime_error&) {
    return "";
  }
}

/// `write`, of what JSON file it is; a file or member that is not what it should be adds nothing
/// but a word that it is so.
template <class Write>
std::string notes_from(const fs::path& file, const Write& write) {
  try {
    return write(formats::read_json<Json>(file));
  } catch (const std::exception&) {
    return html::paragraph(file.filename().string() + " cannot be read.");
  }
}

std::string dataset_of(const Json& experiment) {
  // A list of rows alone has none.
  if (!experiment.is_object()) return "";
  return html::paragraph("Data set: " + experiment.at("dataset").get<std::string>());
}

/// What numbers and short names in the tables stand for.
std::string legend_of(const Json& evaluation) {
  std::string rules, objects, text;
  for (const Json& rule : evaluation.at("all"))
    rules += fmt::format("{}{}: {}", rules.empty() ? "" : "; ", rule.at("rule").get<std::string>(),
                         rule.at("definition").get<std::string>());
  if (evaluation.contains("objects"))
    for (const Json& object : evaluation.at("objects"))
      objects += fmt::format("{}{}: {}", objects.empty() ? "Objects " : ", ",
                             object.at("obj_id").get<int>(), object.value("model", "?"));
  for (const std::string& line : {rules, objects})
    if (!line.empty()) text += html::paragraph(line + ".");
  for (const Json& note : evaluation.at("notes"))
    text += html::paragraph("Note: " + note.get<std::string>() + ".");
  return text;
}

bool is_report(const fs::path& svg) {
  return svg.extension() == ".svg" && is_file(fs::path(svg).replace_extension("csv")) &&
         is_file(fs::path(svg).replace_extension("json"));
}

}  // namespace

std::vector<html::Section> evaluation_sections(const fs::path& folder, const std::string& where) {
  if (!is_file(folder / "evaluation.json")) return {};
  std::string markup = to_markup_by_object(read_csv(folder / "evaluation.csv")) +
                       notes_from(folder / "evaluation.json", legend_of) +
                       plot(folder / "precision_recall.svg") +
                       plot(folder / "recall_visibility.svg");
  const std::string instances = to_markup(read_csv(folder / "instances.csv"));
  if (!instances.empty()) markup += html::fold("Instance by instance", instances);
  return {{where.empty() ? "Evaluation" : where, markup}};
}

std::vector<html::Section> experiment_sections(const fs::path& folder, const std::string& where) {
  std::vector<html::Section> sections;
  for (const fs::path& svg : list_folder(folder)) {
    if (!is_report(svg)) continue;
    const fs::path base = fs::path(svg).replace_extension();
    sections.push_back({(where.empty() ? fs::path() : fs::path(where)) / base.filename(),
                        notes_from(base.string() + ".json", dataset_of) +
                            to_markup_by_object(read_csv(base.string() + ".csv")) + plot(svg)});
  }
  return sections;
}

}  // namespace posevote
