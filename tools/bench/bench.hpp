// SPDX-License-Identifier: BSD-3-Clause
// `posevote bench`: how long each stage takes, on the user's own scans.
#pragma once

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
  std::vector<std::string> growth;  ///< what grows, on input of its own; empty: nothing
};
int bench_command(const BenchCommand& command);

/// Prints how time and memory grow with the input and writes OUT.{json,csv,svg}.
void bench_growth(const BenchCommand& command);

/// The table of two files that `bench --out` wrote, stage by stage with the ratio. Throws
/// std::invalid_argument naming a file that is no such thing.
std::string compare_benches(const std::string& before, const std::string& after);

}  // namespace posevote
