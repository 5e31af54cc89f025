// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bench/bench.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, BenchCommand& command) {
  app.footer(
      "Examples:\n  posevote bench uwa --models models/*.ply --scenes rs1.ply --out new.json\n"
      "  posevote bench --growth all --repeat 3 --out growth\n"
      "  posevote bench --compare old.json new.json");
  app.add_option("config", command.config, "A file, or a name from configs/")
      ->type_name("CONFIG")
      ->capture_default_str();
  app.add_option("--models", command.models, "Model files, folders or globs")->type_name("FILE");
  app.add_option("--scenes", command.scenes, "Scan files, folders or globs")->type_name("FILE");
  app.add_option("--methods", command.methods, "Only these, e.g. posevote ransac")
      ->type_name("METHOD");
  add_set(app, command.set);
  app.add_option("--repeat", command.repeat, "Turns; the figures are medians")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_threads(app, command.threads);
  app.add_option("--out", command.out, "Also write the figures as JSON")->type_name("FILE");
  add_json(app, command.json);
  app.add_option("--growth", command.growth,
                 "How time and memory grow with points, models, correspondences, rotations, "
                 "threads, or all of them, on scans that it makes; --out names the files "
                 "without their ending")
      ->type_name("all|points|models|correspondences|rotations|threads");
  app.add_option("--compare", command.compare,
                 "Run nothing; compare two files of --out, the older one first")
      ->expected(2)
      ->type_name("FILE");
}

const auto registered = register_command<BenchCommand>(
    "bench", "Time every stage, and rivals in the same run", add_options,
    [](const BenchCommand& command) {
      return with_threads(command.threads, [&] { return bench_command(command); });
    });

}  // namespace
}  // namespace posevote
