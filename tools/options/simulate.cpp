// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/units.hpp"
#include "tools/command_line.hpp"
#include "tools/commands.hpp"
#include "tools/part/part.hpp"
#include "tools/simulate/sensor_file.hpp"

namespace posevote {
namespace {

struct Options {
  std::string spec;
  bool colors = false;
  part::Command part;
};

std::string footer() {
  return "Examples:\n"
         "  posevote simulate --models part.stl --sensor stereo --ranges 0.5 1 2 --out out/part\n"
         "  posevote simulate configs/demo_scenes.yaml --out out/scenes\n\n"
         "With --models: will it find my part, from how far, how hidden? Drops copies of it among "
         "more and more\nclutter, scans them with the sensor at each range, looks for them with "
         "the "
         "default config and\njudges: recall over range and visible share, false detections, the "
         "confidence from which on to\nbelieve, and one sentence. Writes recall.csv, recall.json "
         "and recall.svg to --out, and for each range\nits scans, results and pictures. A pose is "
         "right within a tenth of the part's diameter (ADD, ADI).\n\n"
         "Sensors, of kinds and not of makers; noise of single pixels:\n" +
         list_sensors() +
         "or a YAML file: width, height, field (deg across), noise [m], noise_z2 (what it gains "
         "with the\nsquare of the range) ...\n\n"
         "With a spec: writes a data set in BOP layout, with true poses, and PLY scans in metres "
         "beside it. Its\nmodels are shapes of the project, or meshes of one's own: `models: "
         "[{file: part.stl, unit: mm}]`.";
}

void add_options(CLI::App& app, Options& options) {
  part::Command& part = options.part;
  app.footer(footer());
  CLI::Option* spec =
      app.add_option("spec", options.spec, "What to make (YAML)")->type_name("FILE");
  app.add_flag("--colors", options.colors,
               "With a spec: paint things, and photograph what is scanned; the geometry stays")
      ->needs(spec);
  app.add_option("--models", part.models, "Meshes of one's own parts to look for")
      ->type_name("FILE")
      ->excludes(spec);
  app.add_option("--out", part.out, "A new or empty folder")->required()->type_name("DIR");
  app.add_option("--model-unit", part.model_unit, "Unit of length in --models")
      ->check(CLI::IsMember(formats::units_or_auto()))
      ->capture_default_str();
  app.add_option("--sensor", part.sensor, "A kind of sensor, or a file that describes one")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  app.add_option("--ranges", part.ranges, "From the sensor to what it looks at")
      ->type_name("METRES")
      ->check(number_in(0.1, 20))
      ->capture_default_str();
  app.add_option("--noise", part.noise, "Deviation of ranges, instead of the sensor's own")
      ->type_name("METRES")
      ->check(number_in(0, 0.05));
  app.add_option("--scans", part.scans, "Scans at each range")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--precision", part.precision, "Share of right ones that is wanted")
      ->check(number_in(0, 1))
      ->capture_default_str();
  app.add_option("--seed", part.seed, "Of arrangements and noise")
      ->check(whole_number(1000000000))
      ->capture_default_str();
  add_json(app, part.json);
  app.add_flag("--quick", part.quick, "Four scans at each range: a first idea in a minute");
}

int run(const Options& options) {
  if (!options.part.models.empty()) return part::check(options.part, end_in_order());
  if (options.spec.empty())
    throw std::invalid_argument("expected a spec, or --models FILE..., one of them");
  return simulate_command({options.spec, options.part.out, options.colors});
}

const auto registered = register_command<Options>(
    "simulate", "Make scans with true poses: will it find my part?", add_options,
    [](const Options& options) { return with_threads(0, [&] { return run(options); }); });

}  // namespace
}  // namespace posevote
