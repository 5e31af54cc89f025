// SPDX-License-Identifier: BSD-3-Clause
// What the instances of a scan say of each other, by Bayes' rule. Someone who has most of what he
// looks for before him looks for what is there, so that the rest is likelier to be there, too. And
// where things lie about, each once, a second of a kind is likelier another's look-alike; in a bin of
// equal parts it is not.
#pragma once

#include <cstddef>
#include <vector>

namespace posevote::poses {

/// Of an object, how probable it is that it is there.
struct Companion {
  int obj_id = 0;
  double confidence = 0;
};

/// For each of some instances, confidences in [0, 1), the log odds that all of them give it. `kinds`:
/// of objects that are looked for, >= 1, and no less than those that are given.
std::vector<double> log_odds_in_company(const std::vector<Companion>& instances, std::size_t kinds);

}  // namespace posevote::poses
