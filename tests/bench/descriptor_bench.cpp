// SPDX-License-Identifier: BSD-3-Clause
// Compares descriptors, alone and fused, over a data set with true poses, whatever its layout;
// prints a table for the README. By hand, on a quiet machine:
//
//   build/tests/bench_descriptors DATASET OUT [CONFIG [DESCRIPTOR...]]
//
// inliers   share of correspondences whose two points lie within twice the models' feature spacing
//           of each other under a true pose of their object in that image
// recall    of all true instances, within 50 mm and 7.5 deg; precision of all detections
// margin    lowest and median density over the runner-up's, of detections of objects there are
// s/image   description and matching of a scan
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pipelines/configuration.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/library.hpp"
#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

struct Variant {
  std::string name;
  std::string pipeline;  ///< in pipelines/
  std::string set;       ///< override
};

std::vector<Variant> all_variants() {
  std::vector<Variant> variants;
  for (const std::string name :
       {"point_pairs", "shot", "fpfh", "rops", "spin_images", "usc", "ecsad", "nd_histogram"})
    variants.push_back({name, "recognize", "describe_models.node=describe_" + name});
  for (const std::string name : {"shot", "fpfh", "spin_images", "ecsad", "nd_histogram"})
    variants.push_back(
        {"point_pairs+" + name, "recognize_fused", "describe_models_second.node=describe_" + name});
  return variants;
}

struct Bench {
  std::string dataset, config;
  fs::path out;
  layouts::GroundTruth truth;
};

/// What one variant did.
struct Row {
  std::size_t correspondences = 0, inliers = 0;
  std::vector<double> margins;
  double describe = 0, match = 0;  ///< [s], mean per image
  Counts counts;
};

/// Twice the distance between the models' feature points [m].
double inlier_distance(const Bench& bench, const Variant& variant) {
  const Configuration configuration =
      load_configuration(bench.config, {variant.set}, {}, variant.pipeline);
  const auto library = cached_library(
      configuration, list_models(list_dataset_models(bench.dataset, "test")), bench.out / "cache");
  const auto parameters = graph::effective_parameters(configuration.models);
  return 2 * std::stod(parameters.at("pick_model_features").at("spacing")) *
         static_cast<double>(library->scale.resolution);
}

/// Whether some instance of the object in the image carries the model's point to the scene's.
bool is_inlier(const Bench& bench, const layouts::ImageKey& image, const std::vector<double>& row,
               double distance) {
  const Eigen::Vector3d scene(row[3], row[4], row[5]), model(row[9], row[10], row[11]);
  return std::any_of(bench.truth.instances.begin(), bench.truth.instances.end(),
                     [&](const layouts::TrueInstance& truth) {
                       return truth.scene_id == image.first && truth.im_id == image.second &&
                              truth.obj_id == static_cast<int>(row[0]) &&
                              (truth.T_scene_model * model - scene).norm() <= distance;
                     });
}

void count_inliers(const Bench& bench, const fs::path& csv, const layouts::ImageKey& image,
                   double distance, Row& result) {
  std::ifstream stream(csv);
  std::string line;
  if (!std::getline(stream, line)) throw std::runtime_error(csv.string() + ": cannot be read");
  while (std::getline(stream, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    std::vector<double> row;
    for (double number = 0; numbers >> number;) row.push_back(number);
    if (row.size() != 15) throw std::runtime_error(csv.string() + ": expected 15 numbers a line");
    ++result.correspondences;
    result.inliers += is_inlier(bench, image, row, distance);
  }
}

/// Times and margins of a frame of results.json.
void take_frame(const Bench& bench, const nlohmann::json& frame, Row& result) {
  for (const auto& [stage, seconds] : frame.at("stages").items())
    if (stage.starts_with("describe_") || stage == "fuse_scene")
      result.describe += seconds.get<double>();
    else if (stage == "match_features")
      result.match += seconds.get<double>();
  for (const nlohmann::json& found : frame.at("detections"))
    for (const layouts::TrueInstance& truth : bench.truth.instances) {
      if (truth.scene_id != frame.at("scene_id") || truth.im_id != frame.at("im_id") ||
          truth.obj_id != found.at("obj_id"))
        continue;
      const double runner_up = found.at("runner_up_density");
      result.margins.push_back(found.at("density").get<double>() / std::max(runner_up, 1.0));
      break;
    }
}

Row measure(const Bench& bench, const Variant& variant) {
  const fs::path out = bench.out / variant.name;
  fs::remove_all(out);
  RunCommand run;
  run.config = bench.config;
  run.pipeline = variant.pipeline;
  run.dataset = bench.dataset;
  run.out = out.string();
  run.cache = (bench.out / "cache").string();
  run.set = {
      variant.set,
      "write_correspondences.every=1",
  };
  run.tokens = 1;  // one scan at a time, so that stages are timed by themselves
  run.quiet = true;
  const std::atomic<bool> interrupted = false;
  if (run_command(run, interrupted) != 0)
    throw std::runtime_error(out.string() + ": some images failed");

  Row row;
  const double distance = inlier_distance(bench, variant);
  for (const SceneEntry& scene : list_dataset_scenes(bench.dataset, "test"))
    count_inliers(bench, out / "correspondences" / (scene.name + ".csv"),
                  {scene.file.scene_id, scene.file.im_id}, distance, row);
  std::ifstream stream(out / "results.json");
  const nlohmann::json frames = nlohmann::json::parse(stream).at("frames");
  for (const nlohmann::json& frame : frames) take_frame(bench, frame, row);
  row.describe /= static_cast<double>(frames.size());
  row.match /= static_cast<double>(frames.size());
  EvaluateOptions options;
  options.rules = "pose";
  options.results = (out / "results.csv").string();
  options.least_visible = 0;
  row.counts = evaluate(bench.truth, read_results_csv(options.results), options).all[0].counts;
  return row;
}

std::string to_text(const Variant& variant, Row row) {
  std::sort(row.margins.begin(), row.margins.end());
  const auto margin = [&](std::size_t i) { return row.margins.empty() ? 0 : row.margins[i]; };
  const auto layouts::whole = static_cast<double>(std::max<std::size_t>(row.correspondences, 1));
  char text[256];
  std::snprintf(text, sizeof text, "| %s | %.1f %% | %.3f | %.3f | %.1f, %.1f | %.2f | %.2f |\n",
                variant.name.c_str(), 100 * static_cast<double>(row.inliers) / layouts::whole,
                row.counts.recall(), row.counts.precision(), margin(0),
                margin(row.margins.size() / 2), row.describe, row.match);
  return text;
}

/// The table; `wanted` variants, or all where it is empty.
std::string compare(const Bench& bench, const std::vector<std::string>& wanted) {
  std::string table =
      "\n| descriptor | inliers | recall | precision | margin: lowest, median | describe [s/image] "
      "| match [s/image] |\n|---|---|---|---|---|---|---|\n";
  for (const Variant& variant : all_variants())
    if (wanted.empty() || std::count(wanted.begin(), wanted.end(), variant.name) > 0)
      table += to_text(variant, measure(bench, variant));
  return table;
}

}  // namespace
}  // namespace posevote

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) {
    std::fprintf(stderr, "usage: bench_descriptors DATASET OUT [CONFIG [DESCRIPTOR...]]\n");
    return 2;
  }
  if (arguments.size() == 2) arguments.emplace_back("uwa");
  try {
    spdlog::set_level(spdlog::level::warn);
    const posevote::Bench bench{arguments[0], arguments[2], arguments[1],
                                posevote::layouts::read_ground_truth(arguments[0], "test")};
    std::fputs(posevote::compare(bench, {arguments.begin() + 3, arguments.end()}).c_str(), stdout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
