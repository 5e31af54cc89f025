// SPDX-License-Identifier: BSD-3-Clause
// The program as scripts meet it: exit statuses, what is said of typing mistakes, --json.
#include <catch2/catch.hpp>

#include "tests/support/command.hpp"
#include "tools/program.hpp"

namespace posevote::command_line_test {

using test::CommandResult;
using test::TemporaryFolder;

namespace {

CommandResult run(const TemporaryFolder& folder, const std::string& arguments, int status) {
  const CommandResult result = test::run_posevote(folder, arguments);
  INFO(arguments << "\n" << result.output);
  CHECK(result.status == status);
  return result;
}

void says(const TemporaryFolder& folder, const std::string& arguments, const std::string& text) {
  const CommandResult result = run(folder, arguments, 2);
  INFO(arguments << "\n" << result.output);
  CHECK(result.output.find(text) != std::string::npos);
}

/// Standard output alone must be JSON.
nlohmann::json json_of(const TemporaryFolder& folder, const std::string& arguments) {
  run(folder, arguments + " 2> '" + (folder / "errors.txt").string() + "' | cat", 0);
  return test::read_json(folder / "log.txt");
}

}  // namespace

TEST_CASE("exit statuses are as help says", "[command_line]") {
  const TemporaryFolder folder;
  run(folder, "--version", 0);
  run(folder, "", 2);
  run(folder, "check uwa", 0);
  run(folder, "run", 2);
  run(folder, "evaluate nowhere nowhere.csv", 1);
  run(folder, "report nowhere", 2);
  const auto program = make_program();
  for (const CLI::App* command : shown_commands(program->app)) {
    const CommandResult help = run(folder, command->get_name() + " --help", 0);
    INFO(command->get_name());
    CHECK(help.output.find("Exit status") != std::string::npos);
  }
}

TEST_CASE("what was meant is said", "[command_line]") {
  const TemporaryFolder folder;
  says(folder, "trian", "no command is called 'trian', did you mean 'train'?");
  says(folder, "train --modles a.ply --out x", "'--modles', did you mean '--models'?");
  says(folder, "run --dateset=x", "did you mean '--dataset'?");
  says(folder, "report a b", "nothing is expected at 'b'");
  says(folder, "check uwaa", "uwaa: no such file, did you mean 'uwa'?");
  says(folder, "run uwa --pipeline ransak --models a --scenes b",
       "no pipeline is called 'ransak', did you mean 'ransac'?");
  says(folder, "check uwa --set segment_object.rounds=3", "did you mean 'segment_objects'?");
  says(folder, "check uwa --set load_models.unti=mm", "did you mean 'unit'?");
  says(folder, "nodes describe_shto", "did you mean 'describe_shot'?");
  says(folder, "evaluate a b --rules dorst", "did you mean 'drost'?");
  says(folder, "bench --methods ransca --models a --scenes b", "did you mean 'ransac'?");
  const auto in_file = [&](const std::string& text, const std::string& what) {
    says(folder, "check '" + folder.write("mine.yaml", text) + "'", "mine.yaml:" + what);
  };
  in_file(
      "pipelin: recognize\n",
      "1:1: pipelin: expected the node's parameters, as in {unit: mm}, did you mean 'pipeline'?");
  in_file("pipeline: recognise\n",
          "1:11: no pipeline is called 'recognise', did you mean 'recognize'?");
  in_file("extends: recognise\n",
          "1:10: extends: no pipeline is called 'recognise', did you mean 'rec");
  in_file("pipeline: recognize\nload_model: {unit: mm}\n", "2:20: load_model.unit: no such node");
}

TEST_CASE("--json prints JSON and nothing else to standard output", "[command_line]") {
  const TemporaryFolder folder;
  const nlohmann::json nodes = json_of(folder, "nodes --json");
  CHECK(nodes.size() > 30);
  const nlohmann::json one = json_of(folder, "nodes load_models --json");
  CHECK(one["outputs"][0]["type"].is_string());
  CHECK(one["parameters"][0]["default"].is_string());
  CHECK(json_of(folder, "graph uwa --json")["scenes"][0]["node"] == "load_scene");
  CHECK(json_of(folder, "check uwa --json")["problems"].empty());

  const std::string wrong =
      folder.write("wrong.yaml", "pipeline: recognize\nload_models: {unti: mm}\n");
  run(folder, "check '" + wrong + "' --json", 2);
  const nlohmann::json problem = test::read_json(folder / "log.txt")["problems"].at(0);
  CHECK(problem["line"] == 2);
  CHECK(problem["subject"] == "load_models.unti");

  folder.write("a.json", R"({"posevote": {"online_s": 2, "train_s": 1, "stages_s": {"x": 2}}})");
  const std::string file = (folder / "a.json").string();
  const nlohmann::json same =
      json_of(folder, "bench --json --compare '" + file + "' '" + file + "'");
  CHECK(same.at(2)["what"] == "x");
  CHECK(same.at(2)["ratio"] == 1);
}

TEST_CASE("every command that prints a table takes --json", "[command_line]") {
  const auto program = make_program();
  for (const char* name : {"bench", "calibrate", "check", "evaluate", "experiment", "graph",
                           "nodes", "run", "simulate", "train"}) {
    INFO(name);
    CHECK(program->app.get_subcommand(name)->get_option_no_throw("--json"));
  }
}

TEST_CASE("train, run and evaluate with --json", "[command_line]") {
  const TemporaryFolder folder;
  folder.write("spec.yaml",
               "seed: 5\nmodels:\n  - {shape: figure, seed: 3, size: 0.2}\n"
               "scenes:\n  - {sensor: rgbd, objects: [1], clutter: 1}\n");
  const auto at = [&](const std::string& name) { return "'" + (folder / name).string() + "'"; };
  run(folder, "simulate " + at("spec.yaml") + " --out " + at("data"), 0);
  const nlohmann::json library =
      json_of(folder, "train --json --models " + at("data/models") + " --out " + at("x.library"));
  CHECK(library["models"][0]["obj_id"] == 1);
  CHECK(library["models"][0]["symmetries"]["turns"].is_array());
  const nlohmann::json answered =
      json_of(folder, "run bop --json --dataset " + at("data") + " --out " + at("out"));
  CHECK(answered["answered"] == 1);
  const nlohmann::json judged =
      json_of(folder, "evaluate --json " + at("data") + " " + at("out/results.csv"));
  CHECK(judged["all"][0]["recall"] == 1);
  CHECK(judged["instances"][0]["met"]["pose"] == 1);
}

}  // namespace posevote::command_line_test
