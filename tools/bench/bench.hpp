// SPDX-License-Identifier: BSD-3-Clause
// `posevote bench`: how long each stage takes, on the user's own scans.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace posevote {

/// Options of `bench`, named as on the command line.
struct BenchCommand {
  std::string config = "uwa";
  std::vector<std::string> models, scenes, set, methods;
  std::string out;                   ///< JSON file; empty: none
  std::vector<std::string> compare;  ///< two JSON files: nothing is run
  std::size_t threads = 0;
  int repeat = 5;
  bool json = false;
  std::vector<std::string> growth;  ///< what grows, on input of its own; empty: nothing
};
int bench_command(const BenchCommand& command);

/// Prints how time and memory grow with the input and writes OUT.{json,csv,svg}. Returns its rows.
nlohmann::ordered_json bench_growth(const BenchCommand& command);

/// Two files that `bench --out` wrote, stage by stage: a list of {method, what, before_s, after_s,
/// ratio}. Throws std::invalid_argument naming a file that is no such thing.
nlohmann::ordered_json compare_benches(const std::string& before, const std::string& after);
std::string to_table(const nlohmann::ordered_json& comparison);

}  // namespace posevote
