// SPDX-License-Identifier: BSD-3-Clause
#include "graph/problem.hpp"

#include <utility>

#include "graph/did_you_mean.hpp"
#include "graph/schema.hpp"

namespace posevote::graph {
namespace {

std::string lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + to_string(problem);
  return text;
}

}  // namespace

std::string to_string(const Location& where) {
  if (where.line == 0) return where.file;
  return where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

std::string to_string(const Problem& problem) {
  const std::string subject = problem.subject.empty() ? "" : problem.subject + ": ";
  return to_string(problem.where) + ": " + subject + problem.text;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known) {
  const std::string near = closest_name(name, known);
  return near.empty() ? "" : ", did you mean '" + near + "'?";
}

ConfigError::ConfigError(std::vector<Problem> problems)
    : std::runtime_error(lines(problems)), problems_(std::move(problems)) {}

}  // namespace posevote::graph
