// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "nodes/geometry/extent.hpp"
#include "pipelines/inputs.hpp"
#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/json_answer.hpp"
#include "tools/part/part.hpp"
#include "tools/simulate/own_mesh.hpp"
#include "tools/simulate/sensor_file.hpp"
#include "tools/simulate/simulate.hpp"
#include "tools/text.hpp"

namespace posevote::part {
namespace {

namespace fs = std::filesystem;

/// What is wrong is said before anything is made. Returns the diagonal of the largest part [m].
double check_inputs(const Command& command) {
  const fs::path out = command.out;
  if (fs::exists(out) && (!fs::is_directory(out) || !fs::is_empty(out)))
    throw std::invalid_argument(command.out + ": is not an empty folder; choose another --out");
  read_sensor(command.sensor);
  double largest = 0;
  for (const std::string& file : command.models) {
    const Mesh mesh = read_own_mesh(file, command.model_unit);
    const double diagonal = geometry::model_diagonal(mesh.points);
    std::printf("%s: %zu faces, diagonal %.4g m\n", file.c_str(),
                static_cast<std::size_t>(mesh.faces.rows()), diagonal);
    largest = std::max(largest, diagonal);
  }
  for (const double range : command.ranges)
    if (range < largest)
      throw std::invalid_argument(
          format("--ranges %g: is less than the part's diagonal of %.4g m", range, largest));
  return largest;
}

RunCommand make_run(const Command& command, const fs::path& folder) {
  RunCommand run;
  run.dataset = (folder / "scenes").string();
  run.out = (folder / "results").string();
  run.cache = (fs::path(command.out) / "cache").string();
  run.seed = static_cast<std::uint64_t>(command.seed);
  // What the simulation wrote; a set's small parts in mm could pass for metres.
  run.set = {"load_models.unit=mm", "write_picture.every=3"};
  run.quiet = true;
  return run;
}

/// What was found of one range, into the tally.
void judge(const fs::path& folder, double range, Tally& tally) {
  EvaluateOptions options;
  options.rules = "add";
  options.results = (folder / "results" / "results.csv").string();
  const Evaluation evaluation =
      evaluate(layouts::read_ground_truth(folder / "scenes", "test", "none"),
               read_results_csv(options.results), options);
  for (const InstanceResult& one : evaluation.instances)
    if (one.counted)
      tally.outcomes.push_back({range, one.visible.value_or(1), one.met.at(0) > 0,
                                one.met.at(0) > 0 ? one.score : 0, one.obj_id});
  const std::vector<Verdict>& verdicts = evaluation.all.at(0).verdicts;
  tally.verdicts.insert(tally.verdicts.end(), verdicts.begin(), verdicts.end());
  tally.wrong.push_back(static_cast<int>(std::count_if(
      verdicts.begin(), verdicts.end(), [](const Verdict& verdict) { return !verdict.correct; })));
}

void print_range(const Tally& tally) {
  const double range = tally.ranges.back();
  int found = 0, instances = 0;
  for (const Outcome& outcome : tally.outcomes)
    if (outcome.range == range) ++instances, found += outcome.found ? 1 : 0;
  std::printf("%g m: %d of %d found in %d scans, %d false\n", range, found, instances,
              tally.scans.back(), tally.wrong.back());
  std::fflush(stdout);
}

}  // namespace

int check(const Command& given, const std::atomic<bool>& interrupted) {
  const JsonAnswer answer(given.json);
  constexpr int kQuickScans = 4;
  Command command = given;
  if (command.quick) command.scans = std::min(command.scans, kQuickScans);
  std::sort(command.ranges.begin(), command.ranges.end());
  command.models.clear();  // folders and globs become files
  for (const ModelFile& model : list_models(given.models))
    command.models.push_back(model.path.string());
  const double diagonal = check_inputs(command);
  Tally tally;
  for (const std::string& file : command.models)
    tally.parts.push_back(fs::path(file).stem().string());
  fs::create_directories(command.out);
  int worst = 0;
  for (const double range : command.ranges) {
    if (interrupted) return 130;
    const fs::path folder = fs::path(command.out) / format("range_%g_m", range);
    fs::create_directories(folder);
    spdlog::info("{} m: making {} scans", range, command.scans);
    simulate_set(make_spec(command, range, diagonal), folder / "scenes");
    fs::remove_all(folder / "scenes" / "scans");  // the depth images say the same
    spdlog::info("{} m: looking for the parts in them", range);
    const int status = run_command(make_run(command, folder), interrupted);
    if (status > 1) return status;
    worst = std::max(worst, status);
    tally.ranges.push_back(range);
    tally.scans.push_back(command.scans);
    judge(folder, range, tally);
    print_range(tally);
  }
  std::printf("%s", to_text(tally, command).c_str());
  write(tally, command);
  if (given.json) {
    std::ifstream written(fs::path(command.out) / "recall.json");
    answer.give(nlohmann::ordered_json::parse(written));
  }
  return worst;
}

}  // namespace posevote::part
