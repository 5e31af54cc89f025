// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/rules.hpp"

#include <numbers>
#include <sstream>
#include <stdexcept>

#include "graph/did_you_mean.hpp"
#include "graph/schema.hpp"

namespace posevote {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kSteps = 10;  // BOP 2019: every tolerance and threshold goes up in ten steps

using Order = std::function<double(const PairErrors&)>;

/// Centre within `metres` plus `diameters`, rotation within `degrees`.
Condition pose_within(double metres, double diameters, double degrees) {
  return {[=](const PairErrors& e, double diameter) {
            return e.center <= metres + diameters * diameter && e.rotation <= degrees * kDegree;
          },
          [](const PairErrors& e) { return e.center; }};
}

Condition add_within(double diameters) {
  return {[=](const PairErrors& e, double diameter) { return e.add <= diameters * diameter; },
          [](const PairErrors& e) { return e.add; }};
}

Condition adds_within(double diameters) {
  return {[=](const PairErrors& e, double diameter) { return e.adds <= diameters * diameter; },
          [](const PairErrors& e) { return e.adds; }};
}

/// As BOP does it: smaller than, not equal.
Condition below(const Order& error, double limit, bool of_diameter) {
  return {[=](const PairErrors& e, double diameter) {
            return error(e) < (of_diameter ? limit * diameter : limit);
          },
          error};
}

std::vector<Condition> in_steps(const Order& error, double step, bool of_diameter) {
  std::vector<Condition> conditions;
  for (int i = 1; i <= kSteps; ++i) conditions.push_back(below(error, step * i, of_diameter));
  return conditions;
}

std::vector<Condition> vsd_conditions() {
  std::vector<Condition> conditions;
  for (std::size_t tau = 0; tau < kSteps; ++tau)
    for (const Condition& condition : in_steps(
             [tau](const PairErrors& e) {
               return e.vsd_steps.empty() ? kUnknown : e.vsd_steps[tau];
             },
             0.05, false))
      conditions.push_back(condition);
  return conditions;
}

std::vector<Rule> make_rules() {
  return {
      {"pose", "pose 50 mm, 7.5 deg", Needs::poses, {pose_within(0.05, 0, 7.5)}},
      {"drost", "pose diameter/10, 12 deg", Needs::poses, {pose_within(0, 0.1, 12)}},
      {"add", "ADD/ADI 0.1 diameter", Needs::poses, {add_within(0.1)}},
      {"adi15", "ADD/ADI 0.15 diameter", Needs::poses, {add_within(0.15)}},
      {"adds", "ADD-S 0.1 diameter", Needs::poses, {adds_within(0.1)}, true},
      {"mssd", "AR MSSD (BOP19)", Needs::poses,
       in_steps([](const PairErrors& e) { return e.mssd; }, 0.05, true)},
      {"mspd", "AR MSPD (BOP19)", Needs::camera,
       in_steps([](const PairErrors& e) { return e.mspd; }, 5, false)},
      {"vsd", "AR VSD (BOP19)", Needs::depth, vsd_conditions()},
      {"vsd18",
       "VSD 20 mm, 0.3 (SIXD18)",
       Needs::depth,
       {below([](const PairErrors& e) { return e.vsd_2018; }, 0.3, false)},
       true},
  };
}

}  // namespace

const std::vector<Rule>& all_rules() {
  static const std::vector<Rule> rules = make_rules();
  return rules;
}

std::vector<Rule> choose_rules(const std::string& list) {
  if (list == "all") return all_rules();
  std::vector<Rule> chosen;
  std::vector<std::string> known{"all"};
  for (const Rule& rule : all_rules()) known.push_back(rule.name);
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');) {
    const std::size_t before = chosen.size();
    for (const Rule& rule : all_rules())
      if (rule.name == name) chosen.push_back(rule);
    if (chosen.size() == before)
      throw std::invalid_argument("--rules: '" +
                                  std::string(name).append("' is no rule, expected some of ") +
                                  graph::join_list(known) + graph::did_you_mean(name, known));
  }
  if (chosen.empty())
    throw std::invalid_argument("--rules: expected some of " + graph::join_list(known));
  return chosen;
}

}  // namespace posevote
