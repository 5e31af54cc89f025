// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/experiment.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "graph/did_you_mean.hpp"
#include "graph/plugin.hpp"
#include "graph/registry.hpp"
#include "nodes/formats/results_tables.hpp"
#include "tools/ablation/ablation.hpp"
#include "tools/json_answer.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

const std::vector<Method> kMethods = {{"posevote", "recognize", {}},
                                      {"ransac", "ransac", {}},
                                      {"hough3d", "hough3d", {}},
                                      {"geometric_consistency", "geometric_consistency", {}},
                                      {"opencv_ppf", "opencv_ppf", {}}};

/// As PCL's tutorials chain its parts.
const std::vector<std::string> kPclFeatures = {"describe_models.node=describe_shot",
                                               "assemble_library.search=kd_tree"};

/// Not among those that are taken where none is named.
const std::vector<Method> kPeers = {
    {"pcl_hough3d", "hough3d", kPclFeatures},
    {"pcl_geometric_consistency", "geometric_consistency", kPclFeatures},
    {"textbook_density", "recognize", {"estimate_density.node=textbook_density"}}};

/// A rival's pipeline is called as its node.
bool is_missing(const Method& method) {
  return method.pipeline != "recognize" && !graph::find_node(method.pipeline);
}

std::vector<Method> methods_of_this_build() {
  std::vector<Method> methods = kMethods;
  std::erase_if(methods, is_missing);
  return methods;
}

}  // namespace

std::vector<Method> find_methods(const std::vector<std::string>& wanted) {
  if (wanted.empty()) return methods_of_this_build();
  std::vector<Method> known = kMethods;
  known.insert(known.end(), kPeers.begin(), kPeers.end());
  std::vector<Method> methods;
  for (const std::string& name : wanted) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const Method& method) { return method.name == name; });
    if (found == known.end()) {
      std::vector<std::string> names;
      std::string text = "--methods " + name + ": no such method, expected one of";
      for (const Method& method : known) {
        text.append(" ").append(method.name);
        names.push_back(method.name);
      }
      text += graph::did_you_mean(name, names);
      throw std::invalid_argument(text);
    }
    if (is_missing(*found))
      throw std::invalid_argument("--methods " + name + ": " +
                                  graph::unknown_node(found->pipeline));
    methods.push_back(*found);
  }
  return methods;
}

std::vector<Method> methods_of(const ExperimentCommand& command) {
  const bool ranges = command.name == "ranges";
  if (!ranges && !command.scales.empty())
    throw std::invalid_argument("--scales belongs to the experiment ranges");
  std::vector<Method> methods = find_methods(
      ranges && command.methods.empty() ? std::vector<std::string>{"posevote"} : command.methods);
  for (const double scale : command.scales) {
    char name[40], value[40];
    std::snprintf(name, sizeof name, "posevote_%gmm", 1000 * scale);
    std::snprintf(value, sizeof value, "derive_scale.resolution=%g", scale);
    methods.push_back({name, "recognize", {value}});
  }
  return methods;
}

std::string to_csv(const nlohmann::ordered_json& rows) {
  std::string head, text;
  for (const auto& row : rows) {
    head.clear();
    std::string line;
    for (const auto& [key, value] : row.items()) {
      head += (head.empty() ? "" : ",") + key;
      line += (line.empty() ? "" : ",") + formats::csv_field(value);
    }
    text += line + "\n";
  }
  return head + "\n" + text;
}

void write_report(const std::filesystem::path& base, const std::string& json,
                  const std::string& csv, const std::string& svg) {
  write_text(base.string() + ".json", json);
  write_text(base.string() + ".csv", csv);
  write_text(base.string() + ".svg", svg);
  std::printf("wrote %s.{json,csv,svg}\n", base.c_str());
}

namespace {

int run_experiment(const ExperimentCommand& command, const std::filesystem::path& out,
                   const std::atomic<bool>& interrupted) {
  if (command.name == "calibration") return calibration_experiment(command, out);
  if (command.name == "ablation") return ablation_experiment(command, out, interrupted);
  return command.name == "sensitivity" ? sensitivity_experiment(command, out, interrupted)
                                       : recognition_experiment(command, out, interrupted);
}

}  // namespace

int experiment_command(const ExperimentCommand& command, const std::atomic<bool>& interrupted) {
  const JsonAnswer answer(command.json);
  const std::filesystem::path out = command.out.empty() ? "out/" + command.name : command.out;
  const int status = run_experiment(command, out, interrupted);
  if (command.json && status <= 1) {
    std::ifstream table(out / (command.name + ".json"));
    answer.give(nlohmann::ordered_json::parse(table));
  }
  return status;
}

}  // namespace posevote
