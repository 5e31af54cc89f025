// SPDX-License-Identifier: BSD-3-Clause
// What was run: OUT/run.json, a list with an entry for each start (--resume adds one). It is for
// people, and for `posevote view`, which finds scans and models again by it. No result depends on it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "nodes/data/model.hpp"
#include "tools/commands.hpp"

namespace posevote {

/// A model that a run looked for.
struct SoughtModel {
  int obj_id = 0;
  std::string name;
  std::string file;  ///< empty where it came in a library
};

/// One start of a run. Paths are as typed, relative to `folder`.
struct RunRecord {
  std::vector<std::string> command;  ///< word by word: posevote run ...
  std::string folder;                ///< in which it was typed
  std::string dataset, split, library;
  std::vector<SoughtModel> models;
};

/// Adds this start to command.out/run.json; only --resume keeps those that are there. `files`: of
/// the models, where they are no library's. Throws std::runtime_error where it cannot be written.
void record_run(const RunCommand& command, const ModelFiles& files, const ModelLibrary& library);

/// What can be read of it; no entry where there is no such file, or another.
std::vector<RunRecord> read_run_records(const std::filesystem::path& folder);

/// Words as one line for a shell.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace posevote
