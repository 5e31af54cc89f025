// SPDX-License-Identifier: BSD-3-Clause
// What is made from the command line's own definitions: man page, completion, the table of commands.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/command.hpp"
#include "tools/docs/completion.hpp"
#include "tools/docs/man_page.hpp"
#include "tools/program.hpp"

namespace posevote::docs_test {

using Words = std::vector<std::string>;

namespace {

/// Standard output and error of a shell command.
std::string shell(const test::TemporaryFolder& folder, const std::string& command) {
  const std::string log = (folder / "shell.txt").string();
  static_cast<void>(std::system(("(" + command + ") > '" + log + "' 2>&1").c_str()));
  return test::read_text(log);
}

bool has(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// What bash offers behind "posevote LINE", with the script that is installed.
std::string in_bash(const test::TemporaryFolder& folder, const std::string& line) {
  const std::string script = folder.write("script", completion_script("bash"));
  const std::string driver = folder.write(
      "driver", "source '" + script + "'\nCOMP_LINE='" POSEVOTE_BINARY " " + line +
                    "'\nCOMP_POINT=${#COMP_LINE}\n_posevote\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
  return shell(folder, "bash '" + driver + "'");
}

/// Whether a program is there; says that a test is left out where it is not.
bool has_program(const test::TemporaryFolder& folder, const std::string& name) {
  if (!shell(folder, "command -v " + name).empty()) return true;
  WARN("skipped: no " + name);
  return false;
}

/// What the line "posevote LINE" becomes in an interactive zsh by the key Tab. The script's name is
/// the one it is installed under.
std::string in_zsh(const test::TemporaryFolder& folder, const std::string& line) {
  const std::string script = folder.write("_posevote", completion_script("zsh"));
  const std::string answer = (folder / "completed").string();
  std::filesystem::remove(answer);
  const std::string driver = folder.write(
      "driver", "zmodload zsh/zpty\nzpty shell zsh -f -i\nzpty -w shell \"" +
                    ("autoload -Uz compinit; compinit -u -D; source '" + script +
                     "'; save() { print -r -- \\$BUFFER > '" + answer +
                     "' }; zle -N save; bindkey '^Xs' save\"\n") +
                    "zpty -w -n shell '" POSEVOTE_BINARY " " + line +
                    "'$'\\t\\C-xs'\n"
                    "repeat 600; do\n  [[ -s '" +
                    answer + "' ]] && break\n  sleep 0.1\n  zpty -r -t shell seen\ndone\n");
  INFO(shell(folder, "cd '" + folder.path().string() + "' && zsh -f '" + driver + "'"));
  REQUIRE(std::filesystem::exists(answer));
  const std::string whole = test::read_text(answer);
  return whole.substr(std::string(POSEVOTE_BINARY " ").size());
}

/// What fish offers behind "posevote LINE".
std::string in_fish(const test::TemporaryFolder& folder, const std::string& line) {
  const std::string script = folder.write("posevote.fish", completion_script("fish"));
  return shell(folder, "cd '" + folder.path().string() + "' && HOME=. fish -c \"source '" + script +
                           "'; complete -C '" POSEVOTE_BINARY " " + line + "'\"");
}

}  // namespace

TEST_CASE("the man page names every command and option", "[docs]") {
  const auto program = make_program();
  const std::string page = man_page(program->app);
  for (const CLI::App* command : shown_commands(program->app)) {
    INFO(command->get_name());
    const std::size_t section = page.find("\n.SS " + command->get_name() + "\n");
    REQUIRE(section != std::string::npos);
    const std::string text = page.substr(section, page.find("\n.S", section + 5) - section);
    CHECK(text.find("Exit status") != std::string::npos);
    for (const CLI::Option* option : shown_options(*command))
      for (const std::string& name : option->get_lnames()) {
        if (name == "help") continue;
        std::string escaped = "\\-\\-" + name;
        for (std::size_t at = 4; (at = escaped.find('-', at)) != std::string::npos; at += 2)
          escaped.insert(at, "\\");
        INFO(name);
        CHECK(text.find("\\fB" + escaped + "\\fR") != std::string::npos);
      }
  }
}

TEST_CASE("the man page is sound to roff", "[docs]") {
  const test::TemporaryFolder folder;
  if (!has_program(folder, "groff")) return;
  const std::string page = folder.write("posevote.1", man_page(make_program()->app));
  CHECK(shell(folder, "groff -man -ww -b -z -Tutf8 '" + page + "'").empty());
  const std::string text = shell(folder, "groff -man -Tascii -P-cbou '" + page + "'");
  CHECK(text.find("--on-error skip|stop") != std::string::npos);
  CHECK(text.find("  posevote run --models part.stl --scenes scans/ --out out/today") !=
        std::string::npos);
}

TEST_CASE("every command, option and closed set of values completes", "[docs]") {
  const auto program = make_program();
  const CLI::App& app = program->app;
  for (const CLI::App* command : shown_commands(app)) {
    INFO(command->get_name());
    CHECK(has(complete(app, {command->get_name().substr(0, 2)}).words, command->get_name()));
    const Words offered = complete(app, {command->get_name(), "--"}).words;
    for (const CLI::Option* option : shown_options(*command))
      for (const std::string& name : option->get_lnames()) CHECK(has(offered, "--" + name));
  }
  CHECK(complete(app, {"complet"}).words.empty());  // for scripts
  CHECK(complete(app, {"run", "--on-error", ""}).words == Words{"skip", "stop"});
  CHECK(has(complete(app, {"run", "uw"}).words, "uwa"));
  CHECK(complete(app, {"run", "uw"}).files == Completion::Files::kAll);
  CHECK(complete(app, {"run", "--out", ""}).files == Completion::Files::kFolders);
  CHECK(complete(app, {"run", "--models", "a.ply", ""}).files == Completion::Files::kAll);
  CHECK(complete(app, {"run", "--quiet", "uw"}).words == Words{"uwa"});
  CHECK(has(complete(app, {"nodes", "describe_s"}).words, "describe_shot"));
  CHECK(has(complete(app, {"run", "--pipeline", ""}).words, "ransac"));
  CHECK(has(complete(app, {"run", "--model-unit", ""}).words, "mm"));
  CHECK(complete(app, {"run", "--threads", ""}).words.empty());
  CHECK(complete(app, {"nowhere", ""}).words.empty());
  CHECK(complete(app, {"run", "one", "two"}).words.empty());
}

TEST_CASE("--set completes with the parameters of the config that was typed", "[docs]") {
  const auto program = make_program();
  const auto offered = [&](const Words& words) { return complete(program->app, words).words; };
  CHECK(has(offered({"run", "uwa", "--set", "load_mo"}), "load_models.unit="));
  CHECK(has(offered({"run", "uwa", "--set", "load_models.unit="}), "load_models.unit=mm"));
  CHECK(has(offered({"run", "--set", "fold_votes.enabled="}), "fold_votes.enabled=true"));
  CHECK(offered({"run", "uwa", "--set", "ransac."}).empty());
  const std::string file = POSEVOTE_SOURCE_DIR "/pipelines/ransac.yaml";
  CHECK_FALSE(offered({"check", file, "--set", "ransac."}).empty());
}

TEST_CASE("bash offers what the program says", "[docs]") {
  const test::TemporaryFolder folder;
  folder.write("scan one.ply", "");
  CHECK(in_bash(folder, "tra") == "train\n");
  CHECK(in_bash(folder, "run --on-error s") == "skip\nstop\n");
  CHECK(in_bash(folder, "run --mod").find("--models\n") != std::string::npos);
  // Bash splits at '=', so what stands before it must not come again.
  CHECK(in_bash(folder, "run uwa --set load_models.unit=m").find("mm\n") != std::string::npos);
  CHECK(in_bash(folder, "run uwa --set load_models.unit=m").find("unit") == std::string::npos);
  CHECK(in_bash(folder, "run --scenes " + (folder / "sc").string()).find("scan one.ply") !=
        std::string::npos);
}

TEST_CASE("zsh completes what the program says", "[docs]") {
  const test::TemporaryFolder folder;
  if (!has_program(folder, "zsh")) return;
  folder.write("scan one.ply", "");
  CHECK(in_zsh(folder, "tra") == "train \n");
  CHECK(in_zsh(folder, "run --on-error sk") == "run --on-error skip \n");
  CHECK(in_zsh(folder, "run --mode") == "run --model\n");  // -unit or s
  CHECK(in_zsh(folder, "run uwa --set load_models.unit=c") ==
        "run uwa --set load_models.unit=cm \n");
  CHECK(in_zsh(folder, "run uwa --set load_models.un") == "run uwa --set load_models.unit=\n");
  CHECK(in_zsh(folder, "run --scenes sc") == "run --scenes scan\\ one.ply \n");
}

TEST_CASE("fish offers what the program says", "[docs]") {
  const test::TemporaryFolder folder;
  if (!has_program(folder, "fish")) return;
  folder.write("scan one.ply", "");
  CHECK(in_fish(folder, "tra") == "train\n");
  CHECK(in_fish(folder, "run --on-error s") == "skip\nstop\n");
  CHECK(in_fish(folder, "run --mode") == "--models\n--model-unit\n");  // fish's order
  CHECK(in_fish(folder, "run uwa --set load_models.unit=c") == "load_models.unit=cm\n");
  CHECK(in_fish(folder, "run --scenes sc").find("scan one.ply") != std::string::npos);
}

TEST_CASE("there is a script for each shell that asks the program", "[docs]") {
  for (const std::string name : {"bash", "zsh", "fish"})
    CHECK(completion_script(name).find("complete -- ") != std::string::npos);
  CHECK_THROWS_WITH(completion_script("csh"), Catch::Contains("csh"));
}

TEST_CASE("tools/README.md lists every command: `posevote docs --commands` when this fails",
          "[docs]") {
  const std::string readme = test::read_text(POSEVOTE_SOURCE_DIR "/tools/README.md");
  CHECK(readme.find(command_table(make_program()->app)) != std::string::npos);
}

TEST_CASE("graph/README.md draws the default wiring: `posevote docs --wiring default` if not",
          "[docs]") {
  const test::TemporaryFolder folder;
  const std::string drawing = shell(folder, POSEVOTE_BINARY " docs --wiring default");
  REQUIRE(drawing.starts_with("flowchart TD\n"));
  const std::string readme = test::read_text(POSEVOTE_SOURCE_DIR "/graph/README.md");
  CHECK(readme.find("```mermaid\n" + drawing + "```\n") != std::string::npos);
}

}  // namespace posevote::docs_test
