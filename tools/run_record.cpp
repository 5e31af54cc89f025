// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run_record.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tools/text.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFile = "run.json";

/// The command line of this program, as typed.
std::vector<std::string> typed_words() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

Json models_of(const ModelFiles& files, const ModelLibrary& library) {
  Json models = Json::array();
  for (const ModelFile& file : files)
    models.push_back({{"obj_id", file.obj_id}, {"model", file.name}, {"file", file.path.string()}});
  if (!files.empty()) return models;
  for (const auto& model : library.models)
    models.push_back({{"obj_id", model->obj_id}, {"model", model->name}, {"file", ""}});
  return models;
}

Json read_list(const fs::path& folder) {
  std::ifstream stream(folder / kFile);
  Json list = Json::parse(stream, nullptr, false);
  return list.is_array() ? list : Json::array();
}

RunRecord to_record(const Json& json) {
  RunRecord record{json.at("command").get<std::vector<std::string>>(),
                   json.value("folder", ""),
                   json.value("dataset", ""),
                   json.value("split", ""),
                   json.value("library", ""),
                   {}};
  for (const Json& model : json.value("models", Json::array()))
    record.models.push_back({model.at("obj_id").get<int>(), model.at("model").get<std::string>(),
                             model.value("file", "")});
  return record;
}

}  // namespace

void record_run(const RunCommand& command, const ModelFiles& files, const ModelLibrary& library) {
  Json list = command.resume ? read_list(command.out) : Json::array();
  list.push_back({{"command", typed_words()},
                  {"folder", fs::current_path().string()},
                  {"dataset", command.dataset},
                  {"split", command.dataset.empty() ? "" : command.split},
                  {"library", command.library},
                  {"models", models_of(files, library)}});
  write_text(fs::path(command.out) / kFile,
             list.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<RunRecord> read_run_records(const fs::path& folder) {
  std::vector<RunRecord> records;
  for (const Json& json : read_list(folder)) try {
      records.push_back(to_record(json));
    } catch (const Json::exception&) {  // another program's
    }
  return records;
}

std::string shell_line(const std::vector<std::string>& words) {
  constexpr const char* kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./=:,+@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace posevote
