// SPDX-License-Identifier: BSD-3-Clause
// What the READMEs tell people to type: every command and option in them exists.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tools/program.hpp"

namespace posevote::readme_commands_test {

namespace fs = std::filesystem;

namespace {

struct Line {
  std::string where;  ///< README.md:12
  std::string text;
};

std::vector<fs::path> readmes() {
  std::vector<fs::path> files{fs::path(POSEVOTE_SOURCE_DIR) / "README.md"};
  for (const char* folder : {"configs", "graph", "nodes", "pipelines", "tests", "tools"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(POSEVOTE_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".md") files.push_back(entry.path());
  return files;
}

/// What stands before a comment, a pipe or a redirection.
std::string before_shell(const std::string& text) {
  const std::size_t end =
      std::min({text.find(" #"), text.find(" | "), text.find(" > "), text.size()});
  return text.substr(0, end);
}

/// Lines of code that call posevote, with what stands behind the program's name.
std::vector<Line> commands() {
  std::vector<Line> lines;
  for (const fs::path& file : readmes()) {
    std::ifstream stream(file);
    bool fenced = false;
    int number = 0;
    for (std::string text; std::getline(stream, text);) {
      ++number;
      if (text.starts_with("```")) fenced = !fenced;
      if (!fenced && !text.starts_with("    ")) continue;
      const std::size_t at = text.find_first_not_of(' ');
      if (at == std::string::npos) continue;
      text = text.substr(at);
      for (const std::string name : {"posevote ", "build/posevote "})
        if (text.starts_with(name))
          lines.push_back({file.filename().string() + ":" + std::to_string(number),
                           before_shell(text.substr(name.size()))});
    }
  }
  return lines;
}

/// Words of a shell's line; '...' holds one together.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false, begun = false;
  for (const char c : line) {
    if (c == '\'') {
      quoted = !quoted;
      begun = true;
    } else if (c == ' ' && !quoted) {
      if (begun) words.push_back(word);
      word.clear();
      begun = false;
    } else {
      word += c;
      begun = true;
    }
  }
  if (begun) words.push_back(word);
  return words;
}

/// "" for a line that the program takes.
std::string complaint(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  const auto program = make_program();
  try {
    program->app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? "" : error.what();  // --help, --version
  }
  if (program->app.remaining_size(true) > 0) return "unknown: " + program->app.remaining(true)[0];
  return program->chosen ? "" : "names no command";
}

}  // namespace

TEST_CASE("every command in a README is one that the program takes", "[docs]") {
  CHECK(complaint("rum out") != "");
  CHECK(complaint("run --scenes x --modles y") != "");
  const std::vector<Line> lines = commands();
  CHECK(lines.size() > 20);
  for (const Line& line : lines) {
    INFO(line.where << ": posevote " << line.text);
    CHECK(complaint(line.text) == "");
  }
}

}  // namespace posevote::readme_commands_test
