// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/company.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "nodes/poses/confidence.hpp"

namespace posevote::poses {
namespace {

/// The most probable instance of each object.
std::map<int, std::size_t> firsts_of(const std::vector<Companion>& instances) {
  std::map<int, std::size_t> firsts;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const auto [first, is_new] = firsts.try_emplace(instances[i].obj_id, i);
    if (!is_new && instances[i].confidence > instances[first->second].confidence) first->second = i;
  }
  return firsts;
}

/// That one more kind is there if so many of so many others are: Laplace's rule of succession. That
/// few of many are there speaks against none: it does not tell which.
double log_odds_of_presence(double present, double others) {
  return std::max(0.0, std::log((present + 1) / (others - present + 1)));
}

/// That so many instances, each of any of `kinds` kinds, are all of different ones.
double log_probability_of_difference(double instances, double kinds) {
  return std::lgamma(kinds + 1) - std::lgamma(kinds - instances + 1) - instances * std::log(kinds);
}

}  // namespace

// Repeats: either each kind is there at most once, and all of them are false; or how many there are
// does not depend on the kind. Before one looks, one is as likely as the other.
std::vector<double> log_odds_in_company(const std::vector<Companion>& instances,
                                        std::size_t kinds) {
  const std::map<int, std::size_t> firsts = firsts_of(instances);
  const auto all_kinds = static_cast<double>(kinds);
  double present = 0;
  for (const auto& [obj_id, first] : firsts) present += instances[first].confidence;
  std::vector<double> log_odds(instances.size());
  std::vector<char> is_repeat(instances.size(), 1);
  double different = 0;
  for (const auto& [obj_id, first] : firsts) {
    const double own = instances[first].confidence;
    is_repeat[first] = 0;
    log_odds[first] = log_odds_of_presence(present - own, all_kinds - 1);
    different += probability_of(log_odds_of(own) + log_odds[first]);
  }
  double log_once = 0;
  for (std::size_t i = 0; i < instances.size(); ++i)
    if (is_repeat[i] != 0) log_once += std::log1p(-instances[i].confidence);
  const double may_repeat =
      probability_of(log_probability_of_difference(different, all_kinds) - log_once);
  for (std::size_t i = 0; i < instances.size(); ++i)
    if (is_repeat[i] != 0)
      log_odds[i] =
          log_odds_of(may_repeat * instances[i].confidence) - log_odds_of(instances[i].confidence);
  return log_odds;
}

}  // namespace posevote::poses
