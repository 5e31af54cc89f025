// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "graph/plugin.hpp"
#include "graph/wiring.hpp"
#include "nodes/library/content_hash.hpp"
#include "nodes/library/library_file.hpp"
#include "pipelines/library.hpp"
#include "pipelines/recognizer.hpp"
#include "tools/manifest/manifest.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// The command line of this program, as typed.
std::vector<std::string> typed_words() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

RunStart this_start(const std::string& shard) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {typed_words(),
          fs::current_path().string(),
          host,
          static_cast<int>(getpid()),
          std::chrono::duration<double>(now).count(),
          shard,
          0};
}

std::vector<SoughtModel> models_of(const ModelFiles& files, const ModelLibrary& library) {
  std::vector<SoughtModel> models;
  for (const ModelFile& file : files)
    models.push_back({file.obj_id, file.name, file.path.string(), hash_model(file)});
  if (!files.empty()) return models;
  for (const auto& model : library.models) models.push_back({model->obj_id, model->name, "", ""});
  return models;
}

}  // namespace

Manifest describe_run(const RunCommand& command, const Configuration& configuration,
                      const ModelFiles& files, const ModelLibrary& library,
                      std::vector<SceneEntry> scans) {
  Manifest run;
  run.version = version();
  run.code = library::hash_files(graph::code_files(), "");
  run.seed = command.seed;
  for (const graph::Plan* plan : {static_cast<const graph::Plan*>(&configuration.models),
                                  static_cast<const graph::Plan*>(&configuration.scenes)}) {
    run.wiring.merge(graph::wiring(*plan));
    for (const auto& [node, values] : graph::effective_parameters(*plan))
      for (const auto& [param, value] : values) run.parameters[node + "." + param] = value;
  }
  run.dataset = command.dataset;
  run.split = command.dataset.empty() ? "" : command.split;
  run.library = command.library;
  run.cache = command.cache;
  run.library_hash = library::hash_library(library);
  run.models = models_of(files, library);
  run.scans = std::move(scans);
  run.starts = {this_start(command.shard)};
  return run;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quote_for_shell(word);
  return line;
}

}  // namespace posevote
