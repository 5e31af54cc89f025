// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ablation/ablation.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tools/ablation/variations.hpp"
#include "tools/write_text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using ablation::Row;

std::vector<TestSet> find_sets(const ExperimentCommand& command, const fs::path& out) {
  std::vector<std::string> texts = command.sets;
  if (!command.dataset.empty())
    texts.push_back(command.dataset.find('=') == std::string::npos ? "bop=" + command.dataset
                                                                   : command.dataset);
  if (texts.empty())
    texts = command.quick ? std::vector<std::string>{"demo"}
                          : std::vector<std::string>{"uwa", "queens", "icbin", "icmi"};
  std::vector<TestSet> sets;
  for (const std::string& text : texts)
    sets.push_back(find_set(text, command.every, command.quick, out));
  return sets;
}

void check_terms(const std::vector<std::string>& terms) {
  for (const std::string& term : terms)
    if (!ablation::is_term(term))
      throw std::invalid_argument("--terms " + term + ": expected a parameter of " +
                                  ablation::kSegmentation + " or " + ablation::kTraining);
}

/// A term may be out of range for one set's config and not for another's: rows of all sets alone.
void add_outcomes(std::vector<Row>& table, const std::vector<Row>& rows) {
  if (table.empty()) {
    table = rows;
    return;
  }
  std::erase_if(table, [&](Row& row) {
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const Row& other) {
      return other.term == row.term && other.change == row.change;
    });
    if (same == rows.end()) return true;
    row.outcomes.push_back(same->outcomes.at(0));
    if (row.value != same->value) row.value += ", " + same->value;
    return false;
  });
}

}  // namespace

int ablation_experiment(const ExperimentCommand& command, const fs::path& out,
                        const std::atomic<bool>& interrupted) {
  check_terms(command.terms);
  fs::create_directories(out);
  std::vector<TestSet> sets;
  std::vector<Row> table;
  for (const TestSet& set : find_sets(command, out)) {
    add_outcomes(table, ablation::ablate(set, command.terms, out / "cache", interrupted));
    sets.push_back(set);
    write_text(out / "ablation.json", ablation::to_json(sets, table).dump(1) + "\n");
    write_text(out / "ablation.csv", ablation::to_csv(sets, table));
    write_text(out / "ablation.md", ablation::to_markdown(sets, table));
    if (interrupted) break;
  }
  std::printf("%s\nwrote %s.{json,csv,md}\n", ablation::to_markdown(sets, table).c_str(),
              (out / "ablation").c_str());
  return interrupted ? 130 : 0;
}

}  // namespace posevote
