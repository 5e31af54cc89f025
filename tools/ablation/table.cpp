// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "tools/ablation/ablation.hpp"

namespace posevote::ablation {
namespace {

std::string format(const char* pattern, double value) {
  char text[32];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

/// What the change does: instances more, false detections more, and times the time; "=" where it
/// finds as many.
std::string difference(const Outcome& changed, const Outcome& base) {
  const double correct = changed.correct - base.correct;
  const int wrong = changed.wrong - base.wrong;
  const std::string found = correct == 0 ? "=" : format("%+.0f", correct);
  const std::string false_ones = wrong == 0 ? "=" : format("%+.0f", wrong);
  const double times = base.seconds > 0 ? changed.seconds / base.seconds : 1;
  return found + " | " + false_ones + " | " + format("%.2f", times);
}

std::string total(const Outcome& base) {
  return format("%.0f", base.correct) + " of " + std::to_string(base.instances) + " | " +
         std::to_string(base.wrong) + " | " + format("%.2f s", base.seconds);
}

}  // namespace

std::string to_markdown(const std::vector<TestSet>& sets, const std::vector<Row>& rows) {
  std::string head = "| term | change | value |", line = "|---|---|---|";
  for (const TestSet& set : sets) {
    head += " " + set.name + ": found | false | time |";
    line += "---|---|---|";
  }
  std::string text = head + "\n" + line + "\n| all | as they are | |";
  for (const Outcome& base : rows.at(0).outcomes) text += " " + total(base) + " |";
  text += "\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    text += "| " + rows[i].term + " | " + rows[i].change + " | " + rows[i].value + " |";
    for (std::size_t s = 0; s < sets.size(); ++s)
      text += " " + difference(rows[i].outcomes.at(s), rows[0].outcomes.at(s)) + " |";
    text += "\n";
  }
  return text;
}

std::string to_csv(const std::vector<TestSet>& sets, const std::vector<Row>& rows) {
  std::string text = "set,term,change,value,instances,correct,false,seconds\n";
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (const Row& row : rows) {
      const Outcome& outcome = row.outcomes.at(s);
      text += sets[s].name + "," + row.term + "," + row.change + "," + row.value + "," +
              std::to_string(outcome.instances) + "," + format("%g", outcome.correct) + "," +
              std::to_string(outcome.wrong) + "," + format("%.4f", outcome.seconds) + "\n";
    }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<TestSet>& sets, const std::vector<Row>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (const Row& row : rows) {
      const Outcome& outcome = row.outcomes.at(s);
      list.push_back({{"set", sets[s].name},
                      {"term", row.term},
                      {"change", row.change},
                      {"value", row.value},
                      {"instances", outcome.instances},
                      {"correct", outcome.correct},
                      {"false", outcome.wrong},
                      {"seconds", outcome.seconds}});
    }
  return list;
}

}  // namespace posevote::ablation
