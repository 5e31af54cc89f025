// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a configuration, and where. All problems are collected, then reported at once.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace posevote::graph {

/// A place in a file; line and column count from 1. Line 0 means the file (or argument) as a whole.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "configs/uwa.yaml:14:18"
std::string to_string(const Location& where);

struct Problem {
  Location where;
  std::string subject;  ///< "node.param", "node", a stream or a key; may be empty
  std::string text;     ///< what is wrong, and what was expected
};

/// "file:line:column: node.param: problem, expected"
std::string to_string(const Problem& problem);

/// Thrown once all problems of a configuration are known.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace posevote::graph
