// SPDX-License-Identifier: BSD-3-Clause
#include "tools/batch/batch.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_status(CLI::App& app, StatusCommand& command) {
  app.footer(
      "Examples:\n  posevote status out/today\n  posevote status out/shard1 out/shard2\n\n"
      "Of each run: frames answered, failed and left of the shards that were started, their rate\n"
      "since its last start, and the process that is at it. It may be asked while the run goes "
      "on.\n"
      "Exit status: 0, or 2 where a folder holds no run.");
  app.add_option("out", command.out, "What `run` took as --out")->required()->type_name("DIR");
  add_json(app, command.json);
}

void add_merge(CLI::App& app, MergeCommand& command) {
  app.footer(
      "Example:\n  posevote run bop --dataset lmo --shard 1/2 --out out/shard1\n"
      "  posevote run bop --dataset lmo --shard 2/2 --out out/shard2\n"
      "  posevote merge out/shard1 out/shard2 --out out/lmo\n\n"
      "The parts must be of one run (scans, models, parameters, wiring, seed, program), and each\n"
      "scan in one of them. Exit status: 0 merged; 2 refused, which says the folder and why, and\n"
      "nothing is written. trace.json, which is times alone, is not merged.");
  app.add_option("parts", command.parts, "What `run` took as --out for each shard")
      ->required()
      ->type_name("DIR");
  app.add_option("--out", command.out, "Folder for the results")->required()->type_name("DIR");
  app.add_flag("--overwrite", command.overwrite, "Take away what an earlier run left in --out");
  add_json(app, command.json);
}

const auto status_registered = register_command<StatusCommand>(
    "status", "Say how far runs are, and who is at them", add_status, status_command);
const auto merge_registered = register_command<MergeCommand>(
    "merge", "Put the shards of a run together", add_merge, merge_command);

}  // namespace
}  // namespace posevote
