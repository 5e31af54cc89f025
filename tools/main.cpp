// SPDX-License-Identifier: BSD-3-Clause
// The command line: its subcommands register themselves (tools/command_line.hpp).
#include <malloc.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <stdexcept>

#include "graph/problem.hpp"
#include "tools/command_line.hpp"

namespace {

using namespace posevote;

/// What one frame frees the next one takes. Otherwise the C library gives large blocks back to the
/// system, which clears them again page by page: a tenth of the time that the densities of half a
/// million votes take, a hundredth of a whole RGB-D frame's.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

/// Decimal digits alone, up to `most`: CLI11 takes signs, other bases ("010" is 8) and what
/// overflows.
CLI::Validator whole_number(std::uint64_t most) {
  return {[most](const std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [last, error] = std::from_chars(text.data(), end, value);
            const bool is_octal = text.size() > 1 && text.front() == '0';
            if (error == std::errc() && last == end && value <= most && !is_octal) return "";
            return "'" + text + "' is no whole number from 0 to " + std::to_string(most);
          },
          "", "whole number"};
}

constexpr std::uint64_t kMostThreads = 1024;

/// As nodes' parameters are read; CLI::Range takes NaN.
CLI::Validator number_in(double low, double high) {
  return {[range = graph::in_range(low, high)](const std::string& text) -> std::string {
            const auto value = graph::Scalar<double>::parse(text);
            if (value && !range.violated_by(*value)) return "";
            return "'" + text + "' is no number " + range.text();
          },
          "", "number"};
}

/// Runs the command with that many threads; a flow graph belongs to the arena that it is made in.
template <class Command>
int with_threads(std::size_t threads, const Command& command) {
  const std::size_t count =
      threads > 0 ? threads : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          count);
  oneapi::tbb::task_arena arena(static_cast<int>(count));
  return arena.execute(command);
}

void add_set(CLI::App* app, std::vector<std::string>& set) {
  app->add_option("--set", set, "Override one parameter: node.param=value (repeatable)")
      ->type_name("NODE.PARAM=VALUE")
      ->allow_extra_args(false);
}

void add_run(CLI::App& app, RunCommand& run) {
  CLI::App* command = app.add_subcommand("run", "Find the models in every scan");
  command->footer(
      "Example:\n  posevote run uwa --models models/*.ply --scenes scans/ --out out/today\n\n"
      "Writes results.csv (BOP format), results.json, failures.json, effective.yaml and "
      "trace.json\n"
      "to --out. Exit status: 0 all frames answered, 1 some failed, 2 nothing ran, 130 Ctrl-C.");
  command->add_option("config", run.config, "A file, or a name from configs/ (demo, uwa, bop ...)")
      ->required();
  command->add_option("--models", run.models, "Model files, folders or globs")->type_name("FILE");
  command->add_option("--scenes", run.scenes, "Scan files, folders or globs")->type_name("FILE");
  command
      ->add_option("--dataset", run.dataset,
                   "A data set (BOP, SIXD 2017, UWA, Queen's): its models and its scans")
      ->type_name("DIR");
  command->add_option("--split", run.split, "Split of the data set")->capture_default_str();
  command->add_option("--out", run.out, "Folder for the results")->capture_default_str();
  command->add_option("--library", run.library, "A library from `posevote train`, not --models")
      ->type_name("FILE");
  command
      ->add_option("--pipeline", run.pipeline,
                   "Other wiring than the config's, from pipelines/ (ransac, hough3d ...)")
      ->type_name("NAME");
  add_set(command, run.set);
  command->add_option("--threads", run.threads, "Threads; 0: all cores")
      ->check(whole_number(kMostThreads))
      ->capture_default_str();
  command->add_option("--tokens", run.tokens, "Frames in flight; 0: 2 x threads")
      ->check(whole_number(kMostThreads))
      ->capture_default_str();
  command->add_option("--seed", run.seed, "Seed of all randomness")
      ->check(whole_number(std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  command
      ->add_option("--cache", run.cache, "Folder for trained libraries; default ~/.cache/posevote")
      ->type_name("DIR");
  command->add_flag("--resume", run.resume, "Go on in an --out that a run has begun");
  command->add_option("--shard", run.shard, "Only every N-th scan, from the I-th on")
      ->type_name("I/N");
  command->add_option("--on-error", run.on_error, "After a frame that fails")
      ->check(CLI::IsMember({"skip", "stop"}))
      ->capture_default_str();
  command->add_flag("--quiet", run.quiet, "Only errors and the last line");
}

struct Options {
  RunCommand run;
  TrainCommand train;
  SimulateCommand simulate;
  EvaluateCommand evaluate;
  ExperimentCommand experiment;
  BenchCommand bench;
  ReportCommand report;
  std::string config, node, docs_file;
  std::vector<std::string> set;
};

void add_train(CLI::App& app, TrainCommand& train) {
  CLI::App* command = app.add_subcommand("train", "Prepare models once, for `run --library`");
  command->add_option("config", train.config, "The config that the runs will use")->required();
  command->add_option("--models", train.models, "Model files, folders or globs")
      ->required()
      ->type_name("FILE");
  command->add_option("--out", train.out, "The library's file")->required()->type_name("FILE");
  add_set(command, train.set);
}

void add_simulate(CLI::App& app, SimulateCommand& simulate) {
  CLI::App* command = app.add_subcommand("simulate", "Make models and cluttered scans of them");
  command->footer(
      "Example:\n  posevote simulate configs/demo_scenes.yaml --out out/scenes\n\n"
      "Writes a data set in BOP layout, with true poses, and PLY scans in metres beside it.");
  command->add_option("spec", simulate.spec, "What to make (YAML)")->required();
  command->add_option("--out", simulate.out, "A new or empty folder for the data set")
      ->required()
      ->type_name("DIR");
}

void add_evaluate(CLI::App& app, EvaluateCommand& evaluate) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Compare results with a data set's true poses");
  command->footer(
      "Example:\n  posevote evaluate lmo out/today/results.csv --rules all --out out/judged\n\n"
      "Rules: pose (50 mm, 7.5 deg), drost (diameter/10, 12 deg), add and adi15 (ADD/ADI 0.1 and\n"
      "0.15 diameter), BOP's average recalls mssd, mspd, vsd, and vsd18 (SIXD 2018); or all.");
  command->add_option("dataset", evaluate.dataset, "A data set: BOP, SIXD 2017, UWA or Queen's")
      ->required();
  command->add_option("results", evaluate.results, "The results.csv of a run on it")->required();
  command->add_option("--split", evaluate.split, "Split of the data set")->capture_default_str();
  command->add_option("--rules", evaluate.rules, "When a pose is right: rules, or all")
      ->default_str("pose,drost,add,adi15")
      ->type_name("RULE,...");
  command->add_option("--visible", evaluate.visible, "Leave out instances less visible")
      ->check(number_in(0, 1))
      ->capture_default_str();
  command
      ->add_option("--targets", evaluate.targets,
                   "Judge only these; default test_targets_bop19.json, if there; none: judge all")
      ->type_name("FILE");
  command
      ->add_option("--min-score", evaluate.min_score,
                   "Count detections from this score up; curves and best F1 take all")
      ->check(number_in(-1e9, 1e9));
  command->add_option("--top", evaluate.top, "Only so many detections of an object in an image")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", evaluate.out, "Folder for tables (CSV, JSON) and plots (SVG)")
      ->type_name("DIR");
  command->add_flag("--verbose", evaluate.verbose, "List all instances, however many");
}

void add_experiment(CLI::App& app, ExperimentCommand& experiment) {
  CLI::App* command = app.add_subcommand("experiment", "Repeat one of the paper's experiments");
  command->footer(
      "Example:\n  posevote experiment sensitivity --dataset bunny.ply\n\n"
      "Runs our method and its rivals on one data set and prints the paper's table with ours "
      "beside\nit; CSV and plots go to --out. A run that was stopped goes on where it was.");
  command->add_option("name", experiment.name, "sensitivity, uwa, queens, icbin, icmi or ablation")
      ->required()
      ->check(CLI::IsMember({"sensitivity", "uwa", "queens", "icbin", "icmi", "ablation"}));
  command
      ->add_option("--dataset", experiment.dataset,
                   "The real data (sensitivity: a mesh in m); default: a replica is made")
      ->type_name("PATH");
  command->add_option("--out", experiment.out, "Folder for everything; default out/NAME")
      ->type_name("DIR");
  command->add_option("--methods", experiment.methods, "Only these, e.g. posevote ransac")
      ->type_name("NAME");
  command
      ->add_option("--every", experiment.every, "Take one image of so many; of sets of images only")
      ->type_name("N")
      ->check(CLI::Range(1, 10000));
  command->add_flag("--quick", experiment.quick, "A small part of it, to see that it works");
  command->add_option("--sets", experiment.sets, "Ablation: replicas, CONFIG=DIR for real sets")
      ->type_name("SET");
  command->add_option("--terms", experiment.terms, "Ablation: only these parameters")
      ->type_name("PARAM");
}

void add_bench(CLI::App& app, BenchCommand& bench) {
  CLI::App* command = app.add_subcommand("bench", "Time every stage, and rivals in the same run");
  command->footer(
      "Examples:\n  posevote bench uwa --models models/*.ply --scenes rs1.ply --out new.json\n"
      "  posevote bench --growth all --repeat 3 --out growth\n"
      "  posevote bench --compare old.json new.json");
  command->add_option("config", bench.config, "A file, or a name from configs/")
      ->capture_default_str();
  command->add_option("--models", bench.models, "Model files, folders or globs")->type_name("FILE");
  command->add_option("--scenes", bench.scenes, "Scan files, folders or globs")->type_name("FILE");
  command->add_option("--methods", bench.methods, "Only these, e.g. posevote ransac")
      ->type_name("NAME");
  add_set(command, bench.set);
  command->add_option("--repeat", bench.repeat, "Turns; the figures are medians")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--threads", bench.threads, "Threads; 0: all cores")
      ->check(whole_number(kMostThreads))
      ->capture_default_str();
  command->add_option("--out", bench.out, "Also write the figures as JSON")->type_name("FILE");
  command
      ->add_option("--growth", bench.growth,
                   "How time and memory grow with points, models, correspondences, rotations, "
                   "threads, or all of them, on scans that it makes; --out names the files "
                   "without their ending")
      ->type_name("WHAT");
  command->add_option("--compare", bench.compare, "Run nothing; compare two files of --out")
      ->expected(2)
      ->type_name("OLD NEW");
}

void add_report(CLI::App& app, ReportCommand& report) {
  CLI::App* command =
      app.add_subcommand("report", "Make one HTML page of what others have written");
  command->footer(
      "Example:\n  posevote report out/today\n\n"
      "Of the folder of a run, an evaluation or an experiment, and the folders in it: tables, "
      "plots\n"
      "and pictures, all in the page itself.");
  command
      ->add_option("folder", report.folder, "What `run`, `evaluate` or `experiment` took as --out")
      ->required()
      ->type_name("DIR");
  command->add_option("--out", report.out, "The page; default report.html in the folder")
      ->type_name("FILE");
  command->add_option("--pictures", report.pictures, "Take in so many pictures at most")
      ->check(whole_number(std::numeric_limits<std::size_t>::max()))
      ->capture_default_str();
}

void add_inspection(CLI::App& app, Options& options) {
  CLI::App* check = app.add_subcommand("check", "Report every problem of a config at once");
  CLI::App* graph = app.add_subcommand("graph", "Print the wiring as Graphviz DOT");
  for (CLI::App* command : {check, graph}) {
    command->add_option("config", options.config, "A file, or a name from configs/")->required();
    add_set(command, options.set);
  }
  CLI::App* nodes = app.add_subcommand("nodes", "List the node types, or explain one");
  nodes->add_option("name", options.node, "Node type");
  CLI::App* docs = app.add_subcommand("docs", "Write the reference of all nodes");
  docs->add_option("file", options.docs_file, "The file to write")->default_val("nodes/README.md");
}

int dispatch(const CLI::App& app, const Options& options) {
  if (app.got_subcommand("run") || app.got_subcommand("experiment")) end_in_order();
  if (app.got_subcommand("run"))
    return with_threads(options.run.threads, [&] { return run_command(options.run, interrupted); });
  if (app.got_subcommand("train"))
    return with_threads(0, [&] { return train_command(options.train); });
  if (app.got_subcommand("simulate"))
    return with_threads(0, [&] { return simulate_command(options.simulate); });
  if (app.got_subcommand("experiment"))
    return with_threads(0, [&] { return experiment_command(options.experiment, interrupted); });
  if (app.got_subcommand("bench"))
    return with_threads(options.bench.threads, [&] { return bench_command(options.bench); });
  if (app.got_subcommand("evaluate"))
    return with_threads(0, [&] { return evaluate_command(options.evaluate); });
  if (app.got_subcommand("report")) return report_command(options.report);
  if (app.got_subcommand("check")) return check_command(options.config, options.set);
  if (app.got_subcommand("graph")) return graph_command(options.config, options.set);
  if (app.got_subcommand("nodes")) return nodes_command(options.node);
  return docs_command(options.docs_file);
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  spdlog::set_default_logger(spdlog::stderr_color_mt("posevote"));
  spdlog::set_pattern("%^%l%$: %v");
  CLI::App app("posevote finds known 3D objects in 3D scans.");
  app.require_subcommand(1);
  Options options;
  add_run(app, options.run);
  add_train(app, options.train);
  add_simulate(app, options.simulate);
  add_evaluate(app, options.evaluate);
  add_experiment(app, options.experiment);
  add_bench(app, options.bench);
  add_report(app, options.report);
  add_inspection(app, options);
  try {
    return command();
  } catch (const graph::ConfigError& error) {
    std::cerr << error.what() << "\n";
  } catch (const std::invalid_argument& error) {
    spdlog::error("{}", error.what());
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return 1;
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  spdlog::set_default_logger(spdlog::stderr_color_mt("posevote"));
  spdlog::set_pattern("%^%l%$: %v");
  CLI::App app("posevote finds known 3D objects in 3D scans.");
  app.require_subcommand(1);
  std::function<int()> chosen;
  for (const CommandEntry& entry : all_commands()) {
    CLI::App* command = app.add_subcommand(entry.name, entry.help);
    command->callback([&chosen, run_it = entry.add(*command)] { chosen = run_it; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return run(chosen);
}
