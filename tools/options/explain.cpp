// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/units.hpp"
#include "tools/command_line.hpp"
#include "tools/explain/command.hpp"
#include "tools/explain/picture.hpp"

namespace posevote {
namespace {

void add_options(CLI::App& app, ExplainCommand& command) {
  app.footer(
      "Examples:\n"
      "  posevote explain out/today --scene scan7\n"
      "  posevote explain out/today --scene 2/3 --object can --try --picture can.png\n"
      "  posevote explain out/today --scene 2/3 --dataset lmo     # with its true poses\n"
      "  posevote explain out/today --dataset lmo                 # all that was missed\n"
      "  posevote explain out/today --scene scan7 --object can --truth can.txt\n\n"
      "Runs that scan once more and says for each object what the best candidate is, what it has\n"
      "in features, matches and votes, how it is judged, and which stage lost it. Of an --object\n"
      "that was found it says where others of its kind may be, and why they were not taken. With\n"
      "the true pose it says where that one stands. Exit status: 0 explained, 2 no such run, scan\n"
      "or object.");
  app.add_option("out", command.out, "What `run` took as --out")->required()->type_name("DIR");
  app.add_option(
         "--scene", command.scene,
         "A scan of it: its name, file, number, or SCENE/IMAGE; default: the only one, or, with "
         "--dataset, what was missed in all")
      ->type_name("NAME");
  app.add_option("--object", command.object, "A model's name or obj_id; default: all")
      ->type_name("NAME");
  app.add_option("--dataset", command.dataset, "The data set of the run, for its true poses")
      ->type_name("DIR");
  app.add_option("--most", command.most, "Of all scans: misses to explain, the first")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--truth", command.truth,
                 "The true T_scene_model of --object: 16 numbers, row by row")
      ->type_name("FILE");
  app.add_option("--truth-unit", command.truth_unit, "Unit of length in --truth")
      ->check(CLI::IsMember(formats::length_units()))
      ->capture_default_str();
  app.add_option("--models", command.models, "The models, where the run did not record them")
      ->type_name("FILE");
  app.add_flag("--try", command.attempt, "Run again with settings that may help, and say which do");
  add_json(app, command.json);
  app.add_option("--picture", command.picture, "A picture of the scan with what --show says in it")
      ->type_name("FILE.png");
  app.add_option("--show", command.show,
                 "In the picture: candidates and true poses; features matched to the object, green "
                 "those that vote for its candidate; or votes by density, as in the paper's figure")
      ->check(CLI::IsMember(explain::drawn()))
      ->capture_default_str();
  add_threads(app, command.threads);
}

const auto registered = register_command<ExplainCommand>(
    "explain", "Say why objects were found in a scan, or not", add_options,
    [](const ExplainCommand& command) {
      return with_threads(command.threads, [&] { return explain_command(command); });
    });

}  // namespace
}  // namespace posevote
