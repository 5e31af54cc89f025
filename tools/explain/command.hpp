// SPDX-License-Identifier: BSD-3-Clause
// `posevote explain`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace posevote {

/// Options of `explain`, named as on the command line.
struct ExplainCommand {
  std::string out, scene, object, dataset, truth, truth_unit = "m", picture, show = "candidates";
  std::vector<std::string> models;
  bool attempt = false, json = false;
  std::size_t most = 100, threads = 0;
};
int explain_command(const ExplainCommand& command);

}  // namespace posevote
