// SPDX-License-Identifier: BSD-3-Clause
// What a run is: OUT/run.json. By it --resume and merge tell whether two runs are the same one,
// status knows what is left to do, and explain and view find scans and models again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/configuration.hpp"
#include "pipelines/inputs.hpp"
#include "tools/commands.hpp"

namespace posevote {

/// Where a run and a sweep keep what is answered, a line for each frame.
inline constexpr const char* kAnswerFiles[] = {"results.json", "scans.json"};

/// A model that a run looked for.
struct SoughtModel {
  int obj_id = 0;
  std::string name;
  std::string file;  ///< empty where it came in a library
  std::string hash;  ///< of its file and symmetries (hash_model); empty where it came in a library
};

/// One start of a run: --resume adds one.
struct RunStart {
  std::vector<std::string> command;  ///< word by word: posevote run ...
  std::string folder;                ///< in which it was typed
  std::string host;
  int process = 0;
  double time = 0;           ///< seconds since 1970
  std::string shard;         ///< "I/N", or empty: all scans
  std::size_t answered = 0;  ///< frames that had an answer then
};

/// Paths are as typed, relative to the folder of the last start.
struct Manifest {
  std::string version, code;  ///< of the program; a hash of its libraries and plugins
  std::uint64_t seed = 0;
  std::map<std::string, std::string> wiring;      ///< by node, of both plans
  std::map<std::string, std::string> parameters;  ///< by node.param
  std::string dataset, split, library, cache;     ///< empty where not said
  std::string library_hash;                       ///< of what the models were made to
  std::vector<SoughtModel> models;
  std::vector<SceneEntry> scans;  ///< of the whole batch, with their cameras
  std::vector<RunStart> starts;
};

/// Of a run that is about to start. `files`: of the models, where they are no library's; `scans`: of
/// all shards.
Manifest describe_run(const RunCommand& command, const Configuration& configuration,
                      const ModelFiles& files, const ModelLibrary& library,
                      std::vector<SceneEntry> scans);

/// Whole or not at all, and on the disk. Throws std::runtime_error.
void write_manifest(const std::filesystem::path& out, const Manifest& manifest);

/// Nothing where there is none. Throws std::runtime_error where it is damaged or another program's.
std::optional<Manifest> read_manifest(const std::filesystem::path& out);

/// What makes the results of two runs differ, scans aside: a sentence for each difference, none
/// where they are the same run. What is `before` comes first.
std::vector<std::string> differences(const Manifest& before, const Manifest& now);

/// Makes `now` a further start of the run in `out`. Throws std::invalid_argument that names what
/// differs where that is another run, or nobody knows which it is, and std::runtime_error where its
/// manifest is damaged.
void take_up(const std::filesystem::path& out, Manifest& now);

/// Words as one line for a shell.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace posevote
