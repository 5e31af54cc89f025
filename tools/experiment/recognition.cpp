// SPDX-License-Identifier: BSD-3-Clause
// The paper's experiments on data sets with true poses (sections 5.2 to 5.5): our method and its
// rivals on the same scans, with one set of parameters, judged by one evaluator.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "nodes/formats/json_text.hpp"
#include "pipelines/inputs.hpp"
#include "pipelines/installed.hpp"
#include "tools/commands.hpp"
#include "tools/evaluate/evaluate.hpp"
#include "tools/evaluate/write_evaluation.hpp"
#include "tools/experiment/conditions.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/experiment/protocol.hpp"
#include "tools/plot/line_chart.hpp"
#include "tools/simulate/simulate.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// One method's line of the table.
struct Row {
  std::string method;
  Evaluation evaluation;
  double seconds = 0;  ///< mean per image: all stages but loading
};

/// One image of how many is taken.
std::size_t step_of(const ExperimentCommand& command) {
  if (command.every > 0) return command.every;
  return command.quick ? find_protocol(command.name).quick_step : 1;
}

std::string spec_of(const ExperimentCommand& command) {
  return (shared_folder() / "configs" / (command.name + "_scenes.yaml")).string();
}

/// The data set to use; the replica is made where it is not there yet, without images that nobody
/// will look at.
fs::path find_dataset(const ExperimentCommand& command, const fs::path& out) {
  if (!command.dataset.empty()) return command.dataset;
  const std::size_t step = step_of(command);
  fs::path dataset = out / (step == 1 ? "replica" : "replica_every_" + std::to_string(step));
  if (fs::exists(dataset)) return dataset;
  spdlog::info("no --dataset: making the replica");
  simulate_set(spec_of(command), dataset, step);
  return dataset;
}

/// Leaves the images that the run does not see out of the truth.
void keep_shard(const fs::path& dataset, const std::string& split, const std::string& shard,
                layouts::GroundTruth& truth) {
  std::set<layouts::ImageKey> seen;
  for (const SceneEntry& scene : take_shard(list_dataset_scenes(dataset.string(), split), shard))
    seen.insert({scene.file.scene_id, scene.file.im_id});
  std::erase_if(truth.instances, [&](const layouts::TrueInstance& instance) {
    return !seen.contains({instance.scene_id, instance.im_id});
  });
}

double seconds_per_image(const fs::path& results_json) {
  const nlohmann::json frames = formats::read_json<nlohmann::json>(results_json).at("frames");
  double sum = 0;
  for (const nlohmann::json& frame : frames)
    for (const auto& [stage, seconds] : frame.at("stages").items())
      if (stage != "load_scene") sum += seconds.get<double>();
  return frames.empty() ? 0 : sum / static_cast<double>(frames.size());
}

RunCommand make_run(const ExperimentCommand& command, const Method& method, const fs::path& dataset,
                    const fs::path& out, const std::string& shard) {
  RunCommand run;
  run.config = command.name;
  run.pipeline = method.pipeline;
  run.dataset = dataset.string();
  run.out = (out / method.name).string();
  run.cache = (out / "cache").string();
  run.set = method.set;
  // OpenCV's training takes minutes for smooth models, and a sixteenth at this spacing.
  if (command.quick && method.name == "opencv_ppf")
    run.set.emplace_back("train_opencv_ppf.sampling=0.1");
  run.shard = shard;
  run.resume = fs::exists(out / method.name / "results.json");
  run.lines = false;
  return run;
}

double best_f1_of(const RuleResult& result) {
  const auto best = best_f1(result.curve);
  return best ? best->counts.f1() : 0;
}

std::string percent(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

void print_table(const std::vector<Row>& rows) {
  std::printf("\n%-24s %7s %9s %7s %8s %10s %8s\n", rows[0].evaluation.rules[0].text.c_str(),
              "recall", "precision", "F1", "best F1", "at score", "s/image");
  for (const Row& row : rows) {
    const RuleResult& all = row.evaluation.all[0];
    const auto best = best_f1(all.curve);
    std::printf("%-24s %7.3f %9.3f %7.3f %8.3f %10.3f %8.2f\n", row.method.c_str(),
                all.counts.recall(), all.counts.precision(), all.counts.f1(), best_f1_of(all),
                best ? best->score : 0, row.seconds);
  }
}

std::string recall_and_f1(double recall, double f1) {
  return percent(recall) + " / " + percent(f1);
}

std::string of_object(const Row& row, int obj_id) {
  const auto found = row.evaluation.objects.find(obj_id);
  if (found == row.evaluation.objects.end()) return "-";
  return recall_and_f1(found->second[0].counts.recall(), best_f1_of(found->second[0]));
}

/// Over the objects, which is what papers report.
std::string mean_of_objects(const Row& row) {
  double recall = 0, f1 = 0;
  for (const auto& [obj_id, results] : row.evaluation.objects)
    recall += results[0].counts.recall(), f1 += best_f1_of(results[0]);
  const auto objects = static_cast<double>(std::max<std::size_t>(1, row.evaluation.objects.size()));
  return recall_and_f1(recall / objects, f1 / objects);
}

/// A line for each object, and the mean over them.
void print_objects(const std::vector<Row>& rows) {
  std::printf("\n%-24s", "recall / best F1");
  for (const Row& row : rows) std::printf(" %21.21s", row.method.c_str());
  for (const auto& [obj_id, name] : rows[0].evaluation.names) {
    std::printf("\n%-24.24s", name.empty() ? std::to_string(obj_id).c_str() : name.c_str());
    for (const Row& row : rows) std::printf(" %21s", of_object(row, obj_id).c_str());
  }
  std::printf("\n%-24s", "mean");
  for (const Row& row : rows) std::printf(" %21s", mean_of_objects(row).c_str());
  std::printf("\n");
}

nlohmann::ordered_json to_json(const RuleResult& result) {
  const Counts& counts = result.counts;
  const auto best = best_f1(result.curve);
  return {{"instances", counts.instances},   {"detections", counts.detections},
          {"correct", counts.correct},       {"recall", counts.recall()},
          {"precision", counts.precision()}, {"f1", counts.f1()},
          {"best_f1", best_f1_of(result)},   {"threshold", best ? best->score : 0}};
}

/// A row for each method over all objects, and for each object of it.
nlohmann::ordered_json to_json(const std::vector<Row>& rows) {
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    const auto add = [&](const std::string& object, const RuleResult& result) {
      nlohmann::ordered_json& line = table.emplace_back();
      line["method"] = row.method;
      line["object"] = object;
      line["rule"] = row.evaluation.rules[0].name;
      line.update(to_json(result));
      line["seconds_per_image"] = row.seconds;
    };
    add("all", row.evaluation.all[0]);
    for (const auto& [obj_id, results] : row.evaluation.objects)
      add(std::to_string(obj_id), results[0]);
  }
  return table;
}

plot::Chart precision_recall(const std::vector<Row>& rows) {
  plot::Chart chart;
  chart.title = rows[0].evaluation.rules[0].text;
  chart.x_label = "recall";
  chart.y_label = "precision";
  chart.x_range = chart.y_range = {0.0, 1.0};
  for (const Row& row : rows) {
    plot::Series series{row.method, {}, {}};
    for (const CurvePoint& point : row.evaluation.all[0].curve) {
      series.x.push_back(point.counts.recall());
      series.y.push_back(point.counts.precision());
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

plot::Chart recall_over_visibility(const std::vector<Row>& rows) {
  plot::Chart chart;
  chart.title = "recall by visibility";
  chart.x_label = "visible [%]";
  chart.y_label = "recall";
  chart.x_range = {0.0, 100.0};
  chart.y_range = {0.0, 1.0};
  for (const Row& row : rows) {
    plot::Series series{row.method, {}, {}};
    for (std::size_t bin = 0; bin < 10; ++bin) {
      const VisibleBin& counts = row.evaluation.all[0].by_visibility[bin];
      if (counts.instances == 0) continue;
      series.x.push_back(10 * static_cast<double>(bin) + 5);
      series.y.push_back(counts.correct / counts.instances);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// What the spec of a replica varies, if anything: prints and writes OUT_conditions.{json,csv,md,svg}.
void report_conditions(const std::vector<MethodCounts>& methods, const fs::path& base) {
  if (methods[0].counts.empty()) return;
  const std::string tables = to_markdown(methods);
  std::printf("\n%s", tables.c_str());
  const nlohmann::ordered_json rows = to_json(methods);
  write_text(base.string() + "_conditions.md", tables);
  write_report(base.string() + "_conditions", rows.dump(1) + "\n", to_csv(rows),
               conditions_svg(methods));
}

}  // namespace

int recognition_experiment(const ExperimentCommand& command, const fs::path& out,
                           const std::atomic<bool>& interrupted) {
  const Protocol& protocol = find_protocol(command.name);
  const std::vector<Method> methods = methods_of(command);
  fs::create_directories(out);
  const fs::path dataset = find_dataset(command, out);
  const std::string split = "test";
  const bool replica = command.dataset.empty();
  const std::string shard = replica ? "" : "1/" + std::to_string(step_of(command));
  layouts::GroundTruth truth = layouts::read_ground_truth(dataset, split);
  keep_shard(dataset, split, shard, truth);

  int worst = 0;
  std::vector<Row> rows;
  std::vector<MethodCounts> conditions;
  for (const Method& method : methods) {
    std::printf("%s\n", method.name.c_str());
    std::fflush(stdout);
    const int status = run_command(make_run(command, method, dataset, out, shard), interrupted);
    if (status > 1) return status;
    worst = std::max(worst, status);  // scans that failed count as not found
    EvaluateOptions options;
    options.rules = protocol.rule;
    options.results = (out / method.name / "results.csv").string();
    const std::vector<FoundInstance> found = read_results_csv(options.results);
    rows.push_back({method.name, evaluate(truth, found, options),
                    seconds_per_image(out / method.name / "results.json")});
    if (replica)
      conditions.push_back({method.name, split_by_conditions(truth, found, options,
                                                             spec_of(command), step_of(command))});
    write_evaluation(rows.back().evaluation, out / method.name / "evaluation");
  }
  const std::string source =
      replica ? "A replica, made by posevote simulate, not the published set." : dataset.string();
  std::printf("\n%s\n", source.c_str());
  print_table(rows);
  print_objects(rows);
  std::printf("\n%s", protocol.paper);
  if (replica) report_conditions(conditions, out / command.name);
  const nlohmann::ordered_json table{{"dataset", source}, {"rows", to_json(rows)}};
  write_report(out / command.name, table.dump(1) + "\n", to_csv(table["rows"]),
               plot::to_svg({precision_recall(rows), recall_over_visibility(rows)}));
  return worst;
}

}  // namespace posevote
