// SPDX-License-Identifier: BSD-3-Clause
// Completion of the command line. The shells' scripts only ask `posevote complete`, so that what
// they offer is what the program takes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace posevote {

/// What may stand in the place of the last word.
struct Completion {
  enum class Files { kNone, kFolders, kAll };

  std::vector<std::string> words;  ///< each whole, of those that begin with the last word
  Files files = Files::kNone;      ///< which names of files may stand there, too
};

/// `words`: behind "posevote"; the last one is being typed and may be empty.
Completion complete(const CLI::App& program, const std::vector<std::string>& words);

/// A line "none", "folders" or "files", then each word on a line.
std::string to_text(const Completion& completion);

/// The script of "bash", "zsh" or "fish".
std::string completion_script(const std::string& shell);

}  // namespace posevote
