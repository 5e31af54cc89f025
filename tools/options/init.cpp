// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/init.hpp"

#include "tools/command_line.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, init::Command& command) {
  app.footer(
      "Examples:\n  posevote init my --models part.stl --scenes scans/\n"
      "  posevote init my --models part.stl --scenes depth/*.png --camera 570 570 319.5 239.5\n\n"
      "Looks at the models and the first scans: units, sizes, spacing, noise, normals and which "
      "way "
      "they\npoint, where the sensor stood. Where sizes leave it open, runs on the first scan say "
      "which unit,\ndepth scale or place of the sensor is meant. Says what it sees and what looks "
      "wrong, and writes to\nDIR: config.yaml, with a comment for each value; README.md, with the "
      "line to run it; first.png, the\nfirst scan with what was found. Exit status: 0 done, 2 "
      "nothing readable or DIR is taken.");
  app.add_option("dir", command.out, "Folder for the config; what is there is not overwritten")
      ->required()
      ->type_name("DIR");
  app.add_option("--models", command.models, "Model files, folders or globs")
      ->required()
      ->type_name("FILE");
  app.add_option("--scenes", command.scenes, "Scan files, folders or globs")
      ->required()
      ->type_name("FILE");
  app.add_option("--camera", command.camera,
                 "Of depth images: fx fy cx cy in pixels. Default: a file beside them that says it "
                 "(scene_camera.json, camera_info.yaml, intrinsics ...)")
      ->expected(4)
      ->type_name("FX FY CX CY")
      ->check(number_in(0.01, 1e6));
  app.add_option("--depth-scale", command.depth_scale,
                 "Of depth images: mm of one unit. Others are tried where nothing is found")
      ->type_name("MM")
      ->check(number_in(1e-6, 1e6));
  app.add_option("--look", command.look, "Scans to look at")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_cache(app, command.cache);
  app.add_flag("--overwrite", command.overwrite, "Write anew what an earlier init wrote to DIR");
  add_json(app, command.json);
}

const auto registered = register_command<init::Command>(
    "init", "Look at new data, say what is wrong, write a config that works", add_options,
    [](const init::Command& command) {
      return with_threads(0, [&] { return init::run(command); });
    });

}  // namespace
}  // namespace posevote
