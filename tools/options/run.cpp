// SPDX-License-Identifier: BSD-3-Clause
#include "graph/schema.hpp"
#include "tools/command_line.hpp"
#include "tools/commands.hpp"
#include "tools/stream/memory.hpp"
#include "tools/stream/run_stream.hpp"

namespace posevote {
namespace {

struct Options {
  RunCommand run;
  StreamOptions stream;
};

/// Units of the files, and where the sensor stood.
void add_frames(CLI::App& app, RunCommand& command) {
  add_unit(app, "--model-unit", command.model_unit, "Unit of length in model files");
  add_unit(app, "--scene-unit", command.scene_unit,
           "Unit of length in scans that are point files (images: load_scene.depth_scale)");
  app.add_option("--sensor-pose", command.sensor_pose,
                 "Where the sensor stood in the frame and unit of scans that are point files: "
                 "'x y z', 'x y z qx qy qz qw' or a 4 x 4 matrix row by row, or a file of these. "
                 "Default: of each scan NAME.ply the file NAME.pose beside it, a PCD's VIEWPOINT, "
                 "or the origin")
      ->type_name("NUMBERS|FILE");
}

/// Stands for a parameter of write_results.
void add_format(CLI::App& app, RunCommand& command) {
  const auto set = [&command](const std::vector<std::string>& formats) {
    command.set.push_back("write_results.format=" + graph::join_list(formats));
  };
  app.add_option_function<std::vector<std::string>>(
         "--format", set,
         "Which results: json (results.json, all there is to say), csv (detections.csv, with "
         "names, in m), bop (results.csv, in mm). Default: all; --resume needs json")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"json", "csv", "bop"}))
      ->type_name("json,csv,bop");
}

/// How frames come, and how many are held.
void add_stream(CLI::App& app, RunCommand& command, StreamOptions& options) {
  app.add_option_function<std::uint64_t>(
         "--memory",
         [&command, &options](std::uint64_t bytes) {
           options.memory = bytes;
           command.set.push_back("load_scene.max_points=" +
                                 std::to_string(stream::most_points(bytes)));
         },
         "What frames in flight may take (2GB, 500MB): fewer are then, and a scan that would take "
         "more by itself fails. Default: half of the machine's")
      ->transform(CLI::AsSizeValue(false))
      ->type_name("SIZE");
  CLI::Option* follow = app.add_flag(
      "--follow", options.follow,
      "Go on with each scan that is written into the folder of --scenes, until Ctrl-C, "
      "SIGTERM, or a file `stop` in it");
  app.add_flag("--real-time", options.real_time,
               "With --follow: of the scans that wait take the newest, and leave out the others")
      ->needs(follow);
  for (const char* other : {"--resume", "--shard", "--dataset"})
    follow->excludes(app.get_option(other));
}

void add_options(CLI::App& app, Options& options) {
  RunCommand& command = options.run;
  app.footer(
      "Examples:\n  posevote run --models part.stl --scenes scans/ --out out/today\n"
      "  posevote run bop --dataset DIR\n\n"
      "Writes results.json, detections.csv, results.csv (BOP format), failures.json, "
      "effective.yaml\n"
      "and trace.json to --out. Exit status: 0 all frames answered, 1 some failed, 2 nothing ran, "
      "130 Ctrl-C.");
  app.add_option("config", command.config,
                 "A file, or a name that `posevote configs` lists (demo, uwa, bop ...)")
      ->type_name("CONFIG")
      ->capture_default_str();
  app.add_option("--models", command.models, "Model files, folders or globs")->type_name("FILE");
  app.add_option("--scenes", command.scenes, "Scan files, folders or globs")->type_name("FILE");
  app.add_option("--dataset", command.dataset,
                 "A data set (BOP, SIXD 2017, UWA, Queen's): its models and its scans")
      ->type_name("DIR");
  app.add_option("--split", command.split, "Split of the data set")->capture_default_str();
  app.add_option("--out", command.out, "Folder for the results")
      ->type_name("DIR")
      ->capture_default_str();
  add_format(app, command);
  app.add_option("--library", command.library, "A library from `posevote train`, not --models")
      ->type_name("FILE");
  app.add_option("--pipeline", command.pipeline,
                 "Other wiring than the config's, as `posevote configs` lists (ransac ...)")
      ->type_name("PIPELINE");
  add_frames(app, command);
  add_set(app, command.set);
  add_threads(app, command.threads);
  app.add_option("--tokens", command.tokens, "Frames in flight; 0: 2 x threads")
      ->check(whole_number(kMostThreads))
      ->capture_default_str();
  add_seed(app, command.seed);
  add_cache(app, command.cache);
  CLI::Option* resume =
      app.add_flag("--resume", command.resume, "Go on in an --out that a run has begun");
  app.add_flag("--overwrite", command.overwrite,
               "Take away what an earlier run left in --out, before the first frame")
      ->excludes(resume);
  app.add_option("--shard", command.shard, "Only every N-th scan, from the I-th on")
      ->type_name("I/N");
  add_stream(app, command, options.stream);
  app.add_option("--on-error", command.on_error, "After a model or a frame that fails")
      ->check(CLI::IsMember({"skip", "stop"}))
      ->capture_default_str();
  add_json(app, command.json);
  CLI::Option* quiet = app.add_flag("--quiet", command.quiet, "Only errors and the last line");
  app.add_flag("-v,--verbose", command.verbose,
               "What was found and measured in every frame, and what each node took")
      ->excludes(quiet);
}

const auto registered = register_command<Options>(
    "run", "Find the models in every scan", add_options, [](const Options& options) {
      return with_threads(options.run.threads,
                          [&] { return run_command(options.run, options.stream, end_in_order()); });
    });

}  // namespace
}  // namespace posevote
